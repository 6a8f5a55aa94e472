//! Models of a `<population>`.

use periplus_diagnostics::{Diagnostics, SourceMap};
use periplus_sdf::{NoIncludes, SdfContext, read_document};
use periplus_xml::{Document, Element};

use crate::replacement::leaf;
use crate::template::shown;

/// The models of a population, or includes, with names and poses.
pub(crate) fn models(population: &Element) -> Vec<Element> {
    let single = population.child("model").or_else(|| population.child("include"));
    let Some(single) = single else { return Vec::new() };
    // The reader places the models; only names and poses matter here.
    let included = single.child("name").map(|name| name.text().into_owned());
    let name = single.value("name").map(str::to_owned).or(included);
    let name = name.or_else(|| {
        let uri = single.child("uri")?.text().into_owned();
        uri.trim_end_matches('/').rsplit('/').next().map(str::to_owned)
    });
    let Some(name) = name else { return Vec::new() };
    let mut stub = Element::new("model")
        .with_attribute("name", name.as_str())
        .with_child(Element::new("link").with_attribute("name", "link"));
    if let Some(pose) = single.child("pose") {
        stub.push(pose.clone());
    }
    let mut placed = population.clone();
    placed.children.retain(|node| {
        node.as_element().is_none_or(|child| !matches!(child.name.as_str(), "model" | "include"))
    });
    placed.push(stub);
    let world = Element::new("world").with_attribute("name", "default").with_child(placed);
    let root = Element::new("sdf").with_attribute("version", "1.6").with_child(world);
    let document = Document { before: Vec::new(), root, after: Vec::new() };
    let (mut sources, mut diagnostics) = (SourceMap::new(), Diagnostics::new());
    let includes = &mut NoIncludes;
    let mut context = SdfContext { sources: &mut sources, diagnostics: &mut diagnostics, includes };
    let scene = read_document(&document, &mut context);
    let models = scene.worlds.into_iter().flat_map(|world| world.models);
    models
        .map(|model| {
            let pose = model.parent_from_model;
            let (position, rpy) = (pose.translation, pose.rpy());
            let numbers = [position.x, position.y, position.z, rpy.roll, rpy.pitch, rpy.yaw];
            let text = numbers.map(shown).join(" ");
            placed_copy(single, &model.name, &text)
        })
        .collect()
}

fn placed_copy(single: &Element, name: &str, pose: &str) -> Element {
    let mut copy = single.clone();
    copy.children.retain(|node| {
        node.as_element().is_none_or(|child| {
            child.name != "pose" && !(child.name == "name" && single.name == "include")
        })
    });
    if single.name == "include" {
        copy.push(leaf("name", name));
    } else if let Some(attribute) = copy.attributes.iter_mut().find(|it| it.name == "name") {
        attribute.value = name.into();
    }
    copy.push(leaf("pose", pose));
    copy
}
