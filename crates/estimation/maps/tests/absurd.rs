//! Extreme resolutions and origins, with which comparisons would not terminate.
#![allow(missing_docs, reason = "tests")]

use periplus_diagnostics::{Diagnostics, SourceMap};
use periplus_maps::{Distro, read_description};

/// Returns the messages about the description of a map; none for a valid one.
fn said(resolution: &str, origin: &str) -> Vec<String> {
    let text = format!(
        "image: a.pgm\nresolution: {resolution}\norigin: {origin}\nnegate: 0\n\
         occupied_thresh: 0.65\nfree_thresh: 0.196\n"
    );
    let mut sources = SourceMap::new();
    let file = sources.add("a.yaml", text);
    let mut diagnostics = Diagnostics::new();
    let read = read_description(file, &sources, Distro::Jazzy, &mut diagnostics);
    assert_eq!(read.is_none(), diagnostics.has_errors());
    diagnostics.iter().map(|found| found.message.clone()).collect()
}

#[test]
fn absurd_resolutions_and_origins_are_refused() {
    for resolution in ["1.0e+308", "1.0e+307", "1.0e+6", "1.0e-300"] {
        let said = said(resolution, "[0, 0, 0]");
        let has_range = said.iter().any(|it| it.contains("from 1e-6 m to 100000 m"));
        assert!(has_range, "{resolution}: {said:?}");
    }
    for origin in ["[1.0e+308, 0, 0]", "[0, -1.0e+10, 0]"] {
        let said = said("0.05", origin);
        assert!(said.iter().any(|it| it.contains("beyond 1000000000.0 m")), "{origin}: {said:?}");
    }
    assert_eq!(said("0.05", "[-1.0e+6, 20, 3]"), Vec::<String>::new());
}
