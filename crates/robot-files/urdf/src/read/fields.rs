//! Attributes and children of one element, with a finding for each fault.

use periplus_diagnostics::{Diagnostic, Diagnostics, Origin};
use periplus_geometry::{parse_number, parse_numbers};
use periplus_sdf::keep;
use periplus_xml::{Attribute, Element};

use crate::robot::Extra;

/// Attribute as a number; `None` if it is missing or, with an error, unreadable.
pub(super) fn number(element: &Element, name: &str, diagnostics: &mut Diagnostics) -> Option<f64> {
    let attribute = element.attribute(name)?;
    if let Some(number) = parse_number(&attribute.value)
        && number.is_finite()
    {
        return Some(number);
    }
    diagnostics.push(bad_number(element, attribute, attribute.value_origin, "a number"));
    None
}

/// Attribute as a number; 0 and an error if it is missing.
pub(super) fn required_number(element: &Element, name: &str, diagnostics: &mut Diagnostics) -> f64 {
    if element.attribute(name).is_none() {
        diagnostics.push(missing_attribute(element, name));
    }
    number(element, name, diagnostics).unwrap_or(0.0)
}

/// Attribute as exactly `N` numbers separated by spaces; `None` if it is missing or, with an error,
/// unreadable.
pub(super) fn vector<const N: usize>(
    element: &Element,
    name: &str,
    diagnostics: &mut Diagnostics,
) -> Option<[f64; N]> {
    let attribute = element.attribute(name)?;
    let wanted = format!("{N} numbers separated by spaces");
    let error = match parse_numbers(&attribute.value) {
        Ok(numbers) => match <[f64; N]>::try_from(numbers) {
            Ok(numbers) if numbers.iter().all(|number| number.is_finite()) => {
                return Some(numbers);
            }
            Ok(_) => bad_number(element, attribute, attribute.value_origin, &wanted)
                .label("every number must be finite"),
            Err(numbers) => bad_number(element, attribute, attribute.value_origin, &wanted)
                .label(format!("these are {}", numbers.len())),
        },
        Err(word) => {
            // Entities make the value shorter than its source; then the whole value is marked.
            let at = attribute.value_origin.0.map_or(Origin::default(), |span| {
                let plain = (span.end - span.start) as usize == attribute.value.len();
                Origin(Some(if plain { span.part(word.start, word.end) } else { span }))
            });
            bad_number(element, attribute, at, &wanted)
        }
    };
    diagnostics.push(error);
    None
}

/// Attribute that must exist and not be empty.
pub(super) fn required_text<'a>(
    element: &'a Element,
    name: &str,
    diagnostics: &mut Diagnostics,
) -> Option<&'a Attribute> {
    match element.attribute(name) {
        None => {
            diagnostics.push(missing_attribute(element, name));
            None
        }
        Some(attribute) if attribute.value.trim().is_empty() => {
            diagnostics.push(
                Diagnostic::error(
                    "missing-attribute",
                    format!("the `{name}` of this `{}` is empty", element.name),
                )
                .at(attribute.origin)
                .help("write a name"),
            );
            None
        }
        Some(attribute) => Some(attribute),
    }
}

/// Name in a required attribute. White space around it is removed, because SDF, to which Gazebo converts
/// the file, does not allow it.
pub(super) fn required_name(
    element: &Element,
    name: &str,
    diagnostics: &mut Diagnostics,
) -> Option<String> {
    let attribute = required_text(element, name, diagnostics)?;
    let plain = attribute.value.trim();
    if plain.len() < attribute.value.len() {
        diagnostics.push(
            Diagnostic::warning("blank-in-name", "white space around a name is ignored")
                .at(attribute.value_origin)
                .replace(
                    attribute.value_origin,
                    plain,
                    "other readers treat it as part of the name",
                ),
        );
    }
    Some(plain.to_owned())
}

/// First child of a name. Reports a warning for each further one, since URDF readers use the first.
pub(super) fn only_child<'a>(
    element: &'a Element,
    name: &'a str,
    diagnostics: &mut Diagnostics,
) -> Option<&'a Element> {
    let mut children = element.named(name);
    let first = children.next()?;
    if let Some(second) = children.next() {
        diagnostics.push(
            Diagnostic::warning(
                "repeated-element",
                format!("`{}` has more than one `{name}`; only the first counts", element.name),
            )
            .at(second.origin)
            .label("this is ignored")
            .related(first.origin, "this one is used")
            .help("keep one of them"),
        );
    }
    Some(first)
}

/// Attributes and children beyond the known ones, each with a warning unless its prefix marks it as an
/// extension. Repetitions of `single` children are kept for the writer; [`only_child`] has reported them.
pub(super) fn extra(
    element: &Element,
    attributes: &[&str],
    single: &[&str],
    many: &[&str],
    diagnostics: &mut Diagnostics,
) -> Extra {
    let mut extra = Extra::default();
    for attribute in &element.attributes {
        if attributes.contains(&&*attribute.name) {
            continue;
        }
        if !attribute.name.contains(':') && attribute.name != "xmlns" {
            let start = attribute.origin.0.map(|span| span.part(0, attribute.name.len()));
            diagnostics.push(
                Diagnostic::warning(
                    "unknown-attribute",
                    format!("`{}` has no attribute `{}`", element.name, attribute.name),
                )
                .at(Origin(start))
                .label("this is ignored")
                .did_you_mean(
                    Origin(start),
                    &attribute.name,
                    attributes.iter().copied(),
                ),
            );
        }
        extra.attributes.push(attribute.clone());
    }
    let mut met: Vec<&str> = Vec::new();
    for child in element.elements() {
        let name = &*child.name;
        if many.contains(&name) {
            continue;
        }
        if single.contains(&name) {
            if met.contains(&name) {
                extra.elements.push(keep(child));
            }
            met.push(name);
            continue;
        }
        if child.prefix().is_none() {
            diagnostics.push(unknown_element(element, child, single.iter().chain(many).copied()));
        }
        extra.elements.push(keep(child));
    }
    extra
}

/// Finding for an unknown child.
pub(super) fn unknown_element<'a>(
    parent: &Element,
    child: &Element,
    known: impl IntoIterator<Item = &'a str>,
) -> Diagnostic {
    Diagnostic::warning(
        "unknown-element",
        format!("`{}` has no child `{}`", parent.name, child.name),
    )
    .at(child.name_origin())
    .label("this is ignored")
    .did_you_mean(child.name_origin(), &child.name, known)
}

fn missing_attribute(element: &Element, name: &str) -> Diagnostic {
    let error = Diagnostic::error(
        "missing-attribute",
        format!("this `{}` has no attribute `{name}`", element.name),
    )
    .at(element.origin);
    let written = element.attributes.iter().map(|attribute| &*attribute.name);
    match periplus_diagnostics::closest(name, written) {
        Some(slip) => {
            let slip = element.attribute(slip);
            let place = slip.and_then(|slip| slip.origin.0.map(|at| at.part(0, slip.name.len())));
            error.replace(Origin(place), name, format!("did you mean `{name}`?"))
        }
        None => error.help(format!("write <{} {name}=\"...\">", element.name)),
    }
}

fn bad_number(element: &Element, attribute: &Attribute, at: Origin, wanted: &str) -> Diagnostic {
    let value = attribute.value.trim();
    if is_xacro(value) {
        return unexpanded(
            format!(
                "`{}` of this `{}` is a xacro expression, not {wanted}",
                attribute.name, element.name
            ),
            attribute.value_origin,
        );
    }
    let error = Diagnostic::error(
        "bad-number",
        format!("`{}` of this `{}` is not {wanted}", attribute.name, element.name),
    )
    .at(at);
    if value.contains(',') {
        error.help("separate the numbers by spaces, not commas")
    } else if value.contains("pi") {
        error.help("write the number out (pi is 3.14159265358979), or use ${pi} in a .xacro file")
    } else if value.ends_with(['f', 'd']) && parse_number(&value[..value.len() - 1]).is_some() {
        error.help("remove the letter at the end")
    } else {
        error.help("write plain decimal numbers: 0.1 -2 1e-3")
    }
}

/// Returns true if a text contains a xacro expression or substitution.
pub(super) fn is_xacro(text: &str) -> bool {
    text.contains("${") || text.contains("$(")
}

/// Finding for xacro syntax in a file that xacro has not expanded.
pub(super) fn unexpanded(message: String, at: Origin) -> Diagnostic {
    Diagnostic::error("unexpanded-xacro", message)
        .at(at)
        .label("only xacro understands this")
        .help(
            "run xacro first (`xacro FILE > robot.urdf`), or name the file `.xacro`: then it is \
             expanded here",
        )
        .note(
            "a file whose <robot> declares xmlns:xacro=\"http://www.ros.org/wiki/xacro\" is \
             expanded by `periplus check` without being asked",
        )
}
