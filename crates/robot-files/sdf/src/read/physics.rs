//! `<physics>`.

use periplus_diagnostics::{Diagnostic, Diagnostics};
use periplus_scene::Physics;
use periplus_xml::Element;

use crate::fields::Fields;
use crate::value::boolean_word;

pub(crate) fn read_physics(element: &Element, diagnostics: &mut Diagnostics) -> Physics {
    let mut fields = Fields::new(element, diagnostics);
    let defaults = Physics::default();
    let name = fields.attribute("name").filter(|it| !it.value.is_empty());
    let default = fields.attribute("default");
    let engine = fields.attribute("type").map_or(defaults.engine, |it| it.value.to_string());
    let mut physics = Physics {
        name: name.map_or(defaults.name, |it| it.value.to_string()),
        default: default.is_some_and(|it| {
            boolean_word(&it.value, it.value_origin, fields.diagnostics).unwrap_or(false)
        }),
        engine,
        max_step_size_s: fields.magnitude("max_step_size", defaults.max_step_size_s),
        real_time_factor: fields.rate("real_time_factor", 1.0),
        real_time_update_rate_hz: fields.rate("real_time_update_rate", 1000.0),
        max_contacts: fields.count("max_contacts", 20),
        extra: Vec::new(),
    };
    if physics.max_step_size_s == 0.0 {
        let place = element.child("max_step_size").map(Element::text_origin).unwrap_or_default();
        fields.diagnostics.push(
            Diagnostic::error("out-of-range", "the step size must be above 0 s")
                .at(place)
                .note("0.001 s is assumed"),
        );
        physics.max_step_size_s = 0.001;
    }
    fields.verbatim(&["dart", "simbody", "bullet", "ode"]);
    physics.extra = fields.finish();
    physics
}
