//! Any text as an SDF file that may include itself: no panic, no endless work; and what was read
//! is written and read again as the same.
#![no_main]

use std::sync::Arc;

use libfuzzer_sys::fuzz_target;
use periplus_diagnostics::{Diagnostics, Origin, SourceMap};
use periplus_sdf::{IncludeResolver, IncludeTarget, NoIncludes, SdfContext, read_document, write};
use periplus_xml::{Document, parse, write_document};

/// `model://self` is the file itself, `model://again/...` too, under different names.
struct Itself(Arc<Document>);

impl IncludeResolver for Itself {
    fn open(
        &mut self,
        uri: &str,
        _: Origin,
        _: &mut SourceMap,
        _: &mut Diagnostics,
    ) -> IncludeTarget {
        if uri.starts_with("model://self") || uri.starts_with("model://again") {
            let document = Arc::clone(&self.0);
            return IncludeTarget::Sdf { document, key: uri.to_owned() };
        }
        IncludeTarget::Missing { tried: Vec::new(), advice: None }
    }
}

fuzz_target!(|text: &str| {
    let mut sources = SourceMap::new();
    let mut diagnostics = Diagnostics::new();
    let file = sources.add("fuzz.sdf", text);
    let Some(document) = parse(file, &sources, &mut diagnostics) else { return };
    let mut includes = Itself(Arc::new(document.clone()));
    let mut context = SdfContext {
        sources: &mut sources,
        diagnostics: &mut diagnostics,
        includes: &mut includes,
    };
    let scene = read_document(&document, &mut context);

    // Writing cannot keep what no XML file can hold, nor poses that overflowed.
    let written = write_document(&write(&scene, &mut Diagnostics::new()));
    let mut sources = SourceMap::new();
    let file = sources.add("again.sdf", written.as_str());
    let Some(document) = parse(file, &sources, &mut Diagnostics::new()) else { return };
    let mut context = SdfContext {
        sources: &mut sources,
        diagnostics: &mut diagnostics,
        includes: &mut NoIncludes,
    };
    let again = read_document(&document, &mut context);
    let twice = write_document(&write(&again, &mut Diagnostics::new()));
    let mut sources = SourceMap::new();
    let file = sources.add("twice.sdf", twice.as_str());
    let document = parse(file, &sources, &mut Diagnostics::new()).expect("what was written");
    let mut context = SdfContext {
        sources: &mut sources,
        diagnostics: &mut diagnostics,
        includes: &mut NoIncludes,
    };
    let third = read_document(&document, &mut context);
    assert_eq!(third, again, "{written}\n{twice}");
});
