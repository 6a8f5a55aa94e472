//! Parameter files of control plugins.

use std::borrow::Cow;
use std::path::Path;

use periplus_diagnostics::{Diagnostic, Diagnostics, Severity, SourceMap};
use periplus_scene::{Model, Plugin, Scene};
use periplus_xml::{Element, Text, XmlNode};

use crate::setting::{LoadContext, mentioned_in};

/// Replaces the URIs of the parameter files of `ros2_control` plugins by the paths of the files, so that
/// they can be opened without the file that refers to them. A missing file is a warning.
pub fn settle_parameter_files(
    scene: &mut Scene,
    sources: &SourceMap,
    setting: &LoadContext<'_>,
    diagnostics: &mut Diagnostics,
) {
    let models = scene.worlds.iter_mut().flat_map(|world| &mut world.models);
    for model in models.chain(&mut scene.models) {
        each_plugin(model, &mut |plugin| {
            if !plugin.filename.contains("ros2_control") {
                return;
            }
            for element in plugin.content.iter_mut().filter(|one| one.name == "parameters") {
                settle(element, sources, setting, diagnostics);
            }
        });
    }
}

fn each_plugin(model: &mut Model, visit: &mut dyn FnMut(&mut Plugin)) {
    model.plugins.iter_mut().for_each(&mut *visit);
    model.models.iter_mut().for_each(|inner| each_plugin(inner, visit));
}

fn settle(
    element: &mut Element,
    sources: &SourceMap,
    setting: &LoadContext<'_>,
    diagnostics: &mut Diagnostics,
) {
    let origin = element.text_origin();
    let written = element.text().trim().to_owned();
    if written.is_empty() {
        return;
    }
    let uri = without_find(&written);
    let from = mentioned_in(origin, sources, &setting.working_folder);
    match setting.resolver.resolve(&uri, &from) {
        Ok(path) => {
            let text = path.display().to_string().into();
            element.children = vec![XmlNode::Text(Text { text, origin })];
        }
        Err(miss) => {
            let mut diagnostic: Diagnostic = miss.into_diagnostic(origin);
            diagnostic.severity = Severity::Warning;
            let note = "the plugin has no parameters of controllers from this file";
            diagnostics.push(diagnostic.note(note));
            if !Path::new(&written).is_absolute() {
                element.children.clear();
            }
        }
    }
}

/// Returns `$(find package)/rest` as `package://package/rest`, for files that xacro has not expanded.
fn without_find(written: &str) -> Cow<'_, str> {
    let found = written.strip_prefix("$(find ").and_then(|rest| rest.split_once(')'));
    match found {
        Some((package, rest)) => {
            let rest = rest.trim_start_matches('/');
            Cow::Owned(format!("package://{}/{rest}", package.trim()))
        }
        None => Cow::Borrowed(written),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn find_becomes_a_package() {
        assert_eq!(without_find("$(find demo)/config/a.yaml"), "package://demo/config/a.yaml");
        assert_eq!(without_find("/home/a.yaml"), "/home/a.yaml");
    }
}
