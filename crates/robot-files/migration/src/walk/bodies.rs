//! Bodies.

use periplus_diagnostics::Diagnostics;
use periplus_sdf::{check_inertia, read_inertial};
use periplus_xml::Element;

use super::Walker;
use crate::entry::MigrationOutcome;
use crate::old_plugin::Surroundings;
use crate::template;

impl<'a> Walker<'a> {
    /// Inertias that no body can have: Gazebo Classic only warned, libsdformat does not load the file.
    pub(super) fn inertia(&mut self, link: &'a Element, around: Surroundings<'a>) {
        let Some(element) = link.child("inertial") else { return };
        let inertial = read_inertial(element, &mut Diagnostics::new());
        let link_name = link.value("name").unwrap_or_default();
        let mut found = Diagnostics::new();
        check_inertia(&inertial, link_name, element, &mut found);
        // Values that are expressions of xacro are not read here.
        let is_template = |text: &str| template::is_template(text);
        if found.is_empty() || contains(element, &is_template) {
            return;
        }
        let name = format!("inertial of link {link_name}");
        let is_static = around
            .model
            .and_then(|model| model.child("static"))
            .is_some_and(|text| template::flag(&text.text()) == Some(true));
        if is_static {
            self.edits.remove(element);
            let remark = "no body has this inertia, and libsdformat refuses it; the model is static, so that none is needed";
            let outcome = MigrationOutcome::Converted;
            self.entry(element, name, "", outcome, vec![remark.to_owned()]);
        } else {
            let remark = "no body has this inertia, and libsdformat refuses the file: the sum of two moments must be larger \
                          than the third; correct the inertia";
            let outcome = MigrationOutcome::NoCounterpart;
            self.entry(element, name, "", outcome, vec![remark.to_owned()]);
        }
    }
}

/// True if the text of an element below satisfies a condition.
fn contains(element: &Element, condition: &dyn Fn(&str) -> bool) -> bool {
    condition(&element.text()) || element.elements().any(|child| contains(child, condition))
}
