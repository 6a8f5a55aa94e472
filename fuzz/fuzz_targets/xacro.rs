//! A xacro file with an include file and a YAML file: a document, or an error with a position, in bounded
//! time. The three are separated by lines of `=====`.
#![no_main]

use std::path::PathBuf;

use libfuzzer_sys::fuzz_target;
use periplus_diagnostics::{Diagnostics, SourceMap, RenderStyle, render};
use periplus_resources::{MemoryHost, Resolver};
use periplus_xacro::{XacroContext, expand};
use periplus_xml::{parse, write_document};

fuzz_target!(|text: &str| {
    let mut parts = text.split("\n=====\n");
    let main = parts.next().unwrap_or_default();
    let host = MemoryHost::new()
        .with_file("/w/.git/HEAD", "")
        .with_file("/w/main.xacro", main)
        .with_file("/w/part.xacro", parts.next().unwrap_or_default())
        .with_file("/w/data.yaml", parts.next().unwrap_or_default())
        .with_file("/w/arm/package.xml", "<package><name>arm</name></package>")
        .with_variable("HOME", "/home/ada");
    let resolver = Resolver::new(&host, &[]);
    let mut sources = SourceMap::new();
    let mut diagnostics = Diagnostics::new();
    let file = sources.add("main.xacro", main);
    let Some(document) = parse(file, &sources, &mut diagnostics) else { return };
    let setting = XacroContext {
        path: PathBuf::from("/w/main.xacro"),
        working_folder: PathBuf::from("/w"),
        arguments: vec![("given".into(), "1".into())],
        host: &host,
        resolver: &resolver,
    };
    // A lenient reader gives a document in spite of some errors.
    let errors_before = diagnostics.errors();
    let expanded = expand(&document, setting, &mut sources, &mut diagnostics);
    assert_eq!(expanded.is_none(), diagnostics.errors() > errors_before);
    for diagnostic in diagnostics.iter().take(20) {
        assert!(diagnostic.span.is_some(), "{} has no place", diagnostic.message);
        let _ = render(diagnostic, &sources, RenderStyle::Plain);
    }
    if let Some(expanded) = expanded {
        let _ = write_document(&expanded.document);
    }
});
