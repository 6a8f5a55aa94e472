//! A launch file in one of three languages, by its first letter, with a file that it may include and one of
//! parameters: a plan or findings, in bounded time. The three are separated by lines of `=====`.
#![no_main]

use libfuzzer_sys::fuzz_target;
use periplus_diagnostics::{RenderStyle, SourceMap, render};
use periplus_launch::{Nothing, Request, plan};
use periplus_resources::{MemoryHost, Resolver};

fuzz_target!(|text: &str| {
    let Some(language) = text.chars().next() else { return };
    let name = match language {
        'y' => "/w/main.launch.yaml",
        '1' => "/w/main.launch",
        _ => "/w/main.launch.xml",
    };
    let mut parts = text[language.len_utf8()..].split("\n=====\n");
    let host = MemoryHost::new()
        .with_file("/w/.git/HEAD", "")
        .with_file(name, parts.next().unwrap_or_default())
        .with_file("/w/part.launch", parts.next().unwrap_or_default())
        .with_file("/w/data.yaml", parts.next().unwrap_or_default())
        .with_file("/w/arm/package.xml", "<package><name>arm</name></package>")
        .with_variable("HOME", "/home/ada");
    let resolver = Resolver::new(&host, &[]);
    let mut sources = SourceMap::new();
    let request = Request {
        file: name.into(),
        arguments: vec![("given".into(), "1".into())],
        host: &host,
        resolver: &resolver,
        outside: &mut Nothing,
    };
    let (plan, found) = plan(request, &mut sources);
    for finding in found.iter().take(20) {
        let _ = render(finding, &sources, RenderStyle::Plain);
    }
    let _ = serde_json::to_string(&plan);
});
