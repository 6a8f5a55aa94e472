//! `<noise>`.

use periplus_diagnostics::Diagnostic;
use periplus_scene::{NoiseKind, NoiseSpec};

use crate::fields::Fields;

const KINDS: [&str; 3] = ["none", "gaussian", "gaussian_quantized"];

/// Child `<noise>` of an element. The type is an attribute, or in lidars and cameras a child.
pub(crate) fn child(fields: &mut Fields<'_, '_>) -> NoiseSpec {
    let Some(mut noise) = fields.open("noise") else { return NoiseSpec::default() };
    let read = read(&mut noise);
    let rest = noise.finish();
    fields.close("noise", rest);
    read
}

/// Noise inside a child: `<x><noise>...</noise></x>`.
pub(crate) fn inside(fields: &mut Fields<'_, '_>, name: &'static str) -> NoiseSpec {
    let Some(mut inner) = fields.open(name) else { return NoiseSpec::default() };
    let noise = child(&mut inner);
    let rest = inner.finish();
    fields.close(name, rest);
    noise
}

/// Noises of several children of a child.
pub(crate) fn group<const N: usize>(
    fields: &mut Fields<'_, '_>,
    name: &'static str,
    parts: [&'static str; N],
) -> [NoiseSpec; N] {
    let Some(mut inner) = fields.open(name) else { return [NoiseSpec::default(); N] };
    let noises = parts.map(|part| inside(&mut inner, part));
    let rest = inner.finish();
    fields.close(name, rest);
    noises
}

fn read(fields: &mut Fields<'_, '_>) -> NoiseSpec {
    let attribute = fields.attribute("type");
    let child = fields.element.child("type");
    let written = fields.text("type").or_else(|| attribute.map(|it| it.value.to_string()));
    let kind = match written.as_deref() {
        // Cameras and lidars default to gaussian, the rest to none.
        None if attribute.is_none() => NoiseKind::Gaussian,
        None | Some("none" | "") => NoiseKind::None,
        Some("gaussian") => NoiseKind::Gaussian,
        Some("gaussian_quantized") => NoiseKind::GaussianQuantized,
        Some(other) => {
            let origin = child
                .map(periplus_xml::Element::text_origin)
                .or(attribute.map(|it| it.value_origin))
                .unwrap_or_default();
            fields.diagnostics.push(
                Diagnostic::error("unknown-type", format!("`{other}` is not a kind of noise"))
                    .at(origin)
                    .note("no noise is assumed")
                    .did_you_mean(origin, other, KINDS),
            );
            NoiseKind::None
        }
    };
    NoiseSpec {
        kind,
        mean: fields.number("mean", 0.0),
        stddev: fields.magnitude("stddev", 0.0),
        bias_mean: fields.number("bias_mean", 0.0),
        bias_stddev: fields.magnitude("bias_stddev", 0.0),
        dynamic_bias_stddev: fields.magnitude("dynamic_bias_stddev", 0.0),
        dynamic_bias_correlation_time_s: fields.magnitude("dynamic_bias_correlation_time", 0.0),
        precision: fields.magnitude("precision", 0.0),
    }
}
