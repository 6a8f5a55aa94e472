//! Any text and any bytes as the YAML and the picture of a map: a map with a value for each cell, or
//! findings. What loads is saved and loads again.
#![no_main]

use libfuzzer_sys::fuzz_target;
use periplus_maps::{Distro, Format, Mode, Saving, Status, load, render};
use periplus_resources::MemoryHost;

fuzz_target!(|bytes: &[u8]| {
    // The text ends at the first zero; the picture follows.
    let end = bytes.iter().position(|&byte| byte == 0).unwrap_or(bytes.len());
    let (yaml, picture) = (&bytes[..end], bytes.get(end + 1..).unwrap_or_default());
    for distro in [Distro::Noetic, Distro::Humble, Distro::Jazzy] {
        let host = MemoryHost::new().with_file("/map.yaml", yaml).with_file("/map.pgm", picture);
        let loaded = load("/map.yaml", distro, &host);
        let Some(map) = loaded.map else {
            assert!(loaded.status != Status::Success && loaded.diagnostics.has_errors());
            continue;
        };
        assert_eq!(map.grid.cells.len(), map.grid.info.len());
        let saving =
            Saving { mode: Mode::Raw, format: Format::Bmp, ..Saving::new("/again", distro) };
        let files = render(&map.grid, &saving);
        let host = MemoryHost::new()
            .with_file(&files.image_path, files.image)
            .with_file(&files.yaml_path, files.yaml);
        // Resolutions below what three decimals or digits show are lost to every saver.
        if map.grid.info.resolution_m > 0.001 && map.grid.info.resolution_m < 1e6 {
            assert!(load("/again.yaml", distro, &host).map.is_some());
        }
    }
});
