//! Any text as a URDF: findings with positions; a robot that can be written and read back; and a model
//! that can be shown as a tree, written as SDF, and converted back to a URDF.
#![no_main]

use libfuzzer_sys::fuzz_target;
use periplus_diagnostics::{Diagnostics, RenderStyle, SourceMap, render};
use periplus_scene::{Scene, tf_tree};
use periplus_sdf::{NoIncludes, SdfContext};
use periplus_urdf::{ConversionOptions, from_model, read, to_model, write};

fuzz_target!(|text: &str| {
    let mut sources = SourceMap::new();
    let mut diagnostics = Diagnostics::new();
    let file = sources.add("fuzz.urdf", text);
    let Some(document) = periplus_xml::parse(file, &sources, &mut diagnostics) else { return };
    let Some(robot) = read(&document, &mut diagnostics) else { return };
    if !diagnostics.has_errors() {
        let written = periplus_xml::write_document(&write(&robot));
        let file = sources.add("again.urdf", written);
        let again = periplus_xml::parse(file, &sources, &mut Diagnostics::new())
            .and_then(|document| read(&document, &mut Diagnostics::new()));
        assert_eq!(again.as_ref(), Some(&robot));
    }
    let mut context = SdfContext {
        sources: &mut sources,
        diagnostics: &mut diagnostics,
        includes: &mut NoIncludes,
    };
    let model = to_model(&robot, ConversionOptions::default(), &mut context);
    for one in diagnostics.iter().take(20) {
        assert!(one.span.is_some(), "{one:?} has no place");
        let _ = render(one, &sources, RenderStyle::Plain);
    }
    let tree = tf_tree(&model);
    assert!(tree.iter().all(|edge| edge.parent != edge.child));
    let _ = from_model(&model, &mut Diagnostics::new());
    let scene = Scene { models: vec![model], ..Scene::default() };
    periplus_sdf::write(&scene, &mut Diagnostics::new());
});
