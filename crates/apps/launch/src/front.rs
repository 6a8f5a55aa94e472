//! Launch files of ROS 2 in XML and YAML.

mod actions;
mod entity;
mod text;

use std::path::Path;

use periplus_diagnostics::{Diagnostic, Diagnostics, SourceMap};

use crate::evaluate::Outcome;
use crate::tree::Action;
use entity::Entity;

pub(crate) use text::text;

/// Actions of a file in XML or YAML.
pub(crate) fn read(
    path: &Path,
    content: &str,
    sources: &mut SourceMap,
    found: &mut Diagnostics,
) -> Outcome<Vec<Action>> {
    let name = path.display().to_string();
    let file = sources.add(name.as_str(), content);
    let is_yaml =
        path.extension().is_some_and(|extension| extension == "yaml" || extension == "yml");
    if is_yaml {
        let Some(root) = periplus_yaml::parse(file, sources)? else {
            return Err(Diagnostic::error("launch-empty", format!("{name} is empty")).into());
        };
        let Some(launch) = root.get("launch") else {
            return Err(Diagnostic::error(
                "launch-root",
                "a YAML launch file must be a mapping `launch: [...]`",
            )
            .at(root.span)
            .into());
        };
        return actions::all(&Entity::yaml("launch", launch));
    }
    let mut findings = Diagnostics::new();
    let document = periplus_xml::parse(file, sources, &mut findings);
    found.append(findings);
    let Some(document) = document else {
        return Err(Diagnostic::error("launch-xml", format!("{name} is not valid XML"))
            .at(sources.whole(file).part(0, 0))
            .into());
    };
    if document.root.local_name() != "launch" {
        return Err(Diagnostic::error(
            "launch-root",
            format!("the root element must be `<launch>`, not `<{}>`", document.root.name),
        )
        .at(document.root.name_origin())
        .into());
    }
    actions::all(&Entity::xml(&document.root))
}
