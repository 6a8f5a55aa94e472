//! Materials.

use periplus_xml::Element;

use super::{Walker, words};
use crate::entry::MigrationOutcome;
use crate::material::{MaterialFiles, without_script};
use crate::old_plugin::Surroundings;
use crate::template;

/// Remark for a material that cannot be looked up.
const UNKNOWN: &str = "the material is neither one of Gazebo Classic's nor in a script that is found: write <ambient>, \
                       <diffuse> and <specular>, or a <pbr> with its textures";

impl<'a> Walker<'a> {
    pub(super) fn material(&mut self, element: &'a Element, around: Surroundings<'a>) {
        if let Some(script) = element.child("script") {
            return self.script(element, script);
        }
        let is_setting =
            around.is_urdf && around.gazebo.is_some() && element.elements().next().is_none();
        if is_setting && element.attribute("name").is_none() {
            let text = element.text();
            let name = element.value("value").unwrap_or(&text);
            if !name.is_empty() {
                self.setting(element, name);
            }
        }
    }

    /// `<material>Gazebo/Red</material>` in a `<gazebo>` of a URDF.
    fn setting(&mut self, element: &'a Element, name: &str) {
        let old = format!("material {name}");
        if template::is_template(name) {
            let remark =
                "the name is an expression and stays; gz-sim knows the names Gazebo/... too";
            let outcome = MigrationOutcome::Approximated;
            return self.entry(element, old.clone(), old, outcome, vec![remark.to_owned()]);
        }
        match self.colours(name, &[]) {
            Some(colours) => {
                let mut material = Element::new("material");
                colours.into_iter().for_each(|colour| material.push(colour));
                let visual = Element::new("visual").with_child(material);
                self.edits.replace(element, &[visual]);
                self.entry(
                    element,
                    old,
                    "material with colours",
                    MigrationOutcome::Converted,
                    Vec::new(),
                );
            }
            None => {
                let outcome = MigrationOutcome::NoCounterpart;
                self.entry(element, old, "", outcome, vec![UNKNOWN.to_owned()]);
            }
        }
    }

    /// `<script>` of a material in SDF.
    fn script(&mut self, material: &'a Element, script: &'a Element) {
        let text = script.text();
        let name = script.child("name").map(|name| name.text().into_owned());
        let name = name.unwrap_or_else(|| text.into_owned());
        let uris: Vec<String> = script.named("uri").map(|uri| uri.text().into_owned()).collect();
        let old = format!("material script {name}");
        let Some(colours) = self.colours(&name, &uris) else {
            let outcome = MigrationOutcome::NoCounterpart;
            return self.entry(script, old, "", outcome, vec![UNKNOWN.to_owned()]);
        };
        // Explicit colours of a material override its script.
        let new: Vec<Element> =
            colours.into_iter().filter(|colour| material.child(&colour.name).is_none()).collect();
        let textures = new.iter().any(|element| element.name == "pbr");
        let words = new.iter().map(words).collect::<Vec<_>>().join(", ");
        if new.is_empty() {
            self.edits.remove(script);
        } else {
            self.edits.replace(script, &new);
        }
        let remarks = if textures {
            vec![
                "the first texture of the script is the albedo map; other passes are left out"
                    .to_owned(),
            ]
        } else {
            Vec::new()
        };
        self.entry(script, old, words, MigrationOutcome::Converted, remarks);
    }

    fn colours(&self, name: &str, uris: &[String]) -> Option<Vec<Element>> {
        let folder = self.context.path.parent()?;
        let files =
            MaterialFiles { host: self.context.host, resolver: self.context.resolver, folder };
        without_script(name, uris, &files)
    }
}
