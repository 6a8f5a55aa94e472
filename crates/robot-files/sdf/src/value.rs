//! Numbers, flags, vectors and colours in the text of an element.

use periplus_diagnostics::{Diagnostic, Diagnostics, Origin};
use periplus_geometry::{format_number, parse_number};
use periplus_scene::Colour;
use periplus_xml::Element;

use crate::fields::unknown_attribute;

/// Reports children and attributes of an element that should contain only text.
pub(crate) fn leaf(element: &Element, known: &[&'static str], diagnostics: &mut Diagnostics) {
    for attribute in &element.attributes {
        let foreign = attribute.name.contains(':') || attribute.name == "xmlns";
        if !foreign && !known.contains(&&*attribute.name) {
            unknown_attribute(element, attribute, known, diagnostics);
        }
    }
    if let Some(child) = element.elements().next() {
        diagnostics.push(
            Diagnostic::warning(
                "unknown-element",
                format!("`<{}>` holds only text; `<{}>` is left out", element.name, child.name),
            )
            .at(child.name_origin()),
        );
    }
}

pub(crate) fn empty(element: &Element, diagnostics: &mut Diagnostics) {
    diagnostics.push(
        Diagnostic::warning(
            "empty-value",
            format!("`<{}>` is empty; the default is used", element.name),
        )
        .at(element.origin),
    );
}

/// One number and nothing else; infinite but not NaN.
pub(crate) fn number_or_infinite(element: &Element, diagnostics: &mut Diagnostics) -> Option<f64> {
    let text = element.text();
    let mut words = words(element, &text);
    let (word, origin) = words.next()?;
    let number = parse_word(word, origin, element, diagnostics)?;
    if let Some((_, second)) = words.next() {
        diagnostics.push(
            Diagnostic::warning(
                "too-many-values",
                format!("`<{}>` takes one number; the rest is left out", element.name),
            )
            .at(second),
        );
    }
    Some(number)
}

/// One finite number.
pub(crate) fn number(element: &Element, diagnostics: &mut Diagnostics) -> Option<f64> {
    let number = number_or_infinite(element, diagnostics)?;
    finite(number, element.text_origin(), element, diagnostics).then_some(number)
}

/// As many finite numbers as the array has elements.
pub(crate) fn numbers<const N: usize>(
    element: &Element,
    diagnostics: &mut Diagnostics,
) -> Option<[f64; N]> {
    let found = all_numbers(element, diagnostics)?;
    if found.len() > N {
        diagnostics.push(
            Diagnostic::warning(
                "too-many-values",
                format!(
                    "`<{}>` takes {N} numbers, not {}; the rest is left out",
                    element.name,
                    found.len()
                ),
            )
            .at(element.text_origin()),
        );
    }
    let Some(first) = found.first_chunk() else {
        wrong_number_of_values(element, &N.to_string(), found.len(), diagnostics);
        return None;
    };
    Some(*first)
}

/// All numbers of the text, each finite.
pub(crate) fn all_numbers(element: &Element, diagnostics: &mut Diagnostics) -> Option<Vec<f64>> {
    let text = element.text();
    let mut found = Vec::new();
    for (word, origin) in words(element, &text) {
        let number = parse_word(word, origin, element, diagnostics)?;
        if !finite(number, origin, element, diagnostics) {
            return None;
        }
        found.push(number);
    }
    Some(found)
}

pub(crate) fn wrong_number_of_values(
    element: &Element,
    wanted: &str,
    found: usize,
    diagnostics: &mut Diagnostics,
) {
    diagnostics.push(
        Diagnostic::error(
            "wrong-number-of-values",
            format!("`<{}>` takes {wanted} numbers, but here are {found}", element.name),
        )
        .at(element.text_origin()),
    );
}

pub(crate) fn boolean(element: &Element, diagnostics: &mut Diagnostics) -> Option<bool> {
    boolean_word(&element.text(), element.text_origin(), diagnostics)
}

pub(crate) fn boolean_word(
    word: &str,
    origin: Origin,
    diagnostics: &mut Diagnostics,
) -> Option<bool> {
    match word.trim().to_ascii_lowercase().as_str() {
        "true" | "1" => Some(true),
        "false" | "0" => Some(false),
        // Gazebo's URDF reader accepts `yes`, which also occurs in SDF.
        "yes" => Some(true),
        "no" => Some(false),
        _ => {
            diagnostics.push(
                Diagnostic::error("not-a-flag", format!("`{word}` is neither true nor false"))
                    .at(origin)
                    .help("write `true`, `false`, `1` or `0`"),
            );
            None
        }
    }
}

/// Every whole number up to 2 to the power of 53 is a double.
const LARGEST_INTEGER: f64 = 9_007_199_254_740_992.0;

pub(crate) fn integer(element: &Element, diagnostics: &mut Diagnostics) -> Option<i64> {
    let value = number(element, diagnostics)?;
    if value.fract() != 0.0 && value.abs() <= LARGEST_INTEGER {
        // Libsdformat ignores characters after the digits too (`std::stoul`).
        diagnostics.push(
            Diagnostic::warning(
                "not-a-whole-number",
                format!(
                    "`<{}>` takes a whole number; {} is read as {}",
                    element.name,
                    format_number(value),
                    format_number(value.trunc())
                ),
            )
            .at(element.text_origin()),
        );
    } else if value.fract() != 0.0 || value.abs() > LARGEST_INTEGER {
        diagnostics.push(
            Diagnostic::error(
                "not-a-whole-number",
                format!("`<{}>` takes a whole number, not {}", element.name, format_number(value)),
            )
            .at(element.text_origin()),
        );
        return None;
    }
    #[expect(
        clippy::cast_possible_truncation,
        reason = "at most 2^53; the fraction is meant to go"
    )]
    Some(value as i64)
}

pub(crate) fn count(element: &Element, diagnostics: &mut Diagnostics) -> Option<u32> {
    let value = hexadecimal(&element.text()).map_or_else(|| integer(element, diagnostics), Some)?;
    // Mask with all bits set, in the notation of C.
    let is_mask = ["mask", "flags"].iter().any(|end| element.name.ends_with(end));
    let value = if value == -1 && is_mask { i64::from(u32::MAX) } else { value };
    let count = u32::try_from(value).ok();
    if count.is_none() {
        diagnostics.push(
            Diagnostic::error(
                "out-of-range",
                format!("`<{}>` must be between 0 and {}, not {value}", element.name, u32::MAX),
            )
            .at(element.text_origin()),
        );
    }
    count
}

/// Parses the hexadecimal notation of masks.
fn hexadecimal(text: &str) -> Option<i64> {
    let digits = text.strip_prefix("0x").or_else(|| text.strip_prefix("0X"))?;
    i64::from_str_radix(digits, 16).ok()
}

/// Red, green, blue and optionally alpha.
pub(crate) fn colour(element: &Element, diagnostics: &mut Diagnostics) -> Option<Colour> {
    let mut found = all_numbers(element, diagnostics)?;
    if found.iter().any(|part| !(0.0..=1.0).contains(part)) {
        diagnostics.push(
            Diagnostic::warning(
                "out-of-range",
                format!("the components of `<{}>` must be between 0 and 1", element.name),
            )
            .at(element.text_origin())
            .note("values outside are clamped; newer Gazebo refuses the whole file"),
        );
        found.iter_mut().for_each(|part| *part = part.clamp(0.0, 1.0));
    }
    match found.as_slice() {
        [r, g, b] => Some(Colour([*r, *g, *b, 1.0])),
        [r, g, b, a] => Some(Colour([*r, *g, *b, *a])),
        other => {
            wrong_number_of_values(element, "3 or 4", other.len(), diagnostics);
            None
        }
    }
}

pub(crate) fn positive(value: f64, element: &Element, diagnostics: &mut Diagnostics) -> bool {
    let holds = value > 0.0;
    if !holds {
        out_of_range(value, "above 0", element, diagnostics);
    }
    holds
}

pub(crate) fn not_negative(value: f64, element: &Element, diagnostics: &mut Diagnostics) -> bool {
    let holds = value >= 0.0;
    if !holds {
        out_of_range(value, "at least 0", element, diagnostics);
    }
    holds
}

pub(crate) fn out_of_range(
    value: f64,
    wanted: &str,
    element: &Element,
    diagnostics: &mut Diagnostics,
) {
    diagnostics.push(
        Diagnostic::error(
            "out-of-range",
            format!("`<{}>` must be {wanted}, not {}", element.name, format_number(value)),
        )
        .at(element.text_origin()),
    );
}

/// Words of an element's text, each with its source location.
fn words<'a>(element: &Element, text: &'a str) -> impl Iterator<Item = (&'a str, Origin)> {
    let origin = element.text_origin();
    let plain = origin.0.is_some_and(|span| (span.end - span.start) as usize == text.len());
    text.split_whitespace().map(move |word| {
        let start = word.as_ptr() as usize - text.as_ptr() as usize;
        let part = origin.0.map(|span| span.part(start, start + word.len()));
        (word, if plain { Origin(part) } else { origin })
    })
}

fn parse_word(
    word: &str,
    origin: Origin,
    element: &Element,
    diagnostics: &mut Diagnostics,
) -> Option<f64> {
    match parse_number(word) {
        Some(number) if number.is_nan() => {
            diagnostics.push(
                Diagnostic::error("not-finite", format!("`<{}>` must not be NaN", element.name))
                    .at(origin)
                    .note("the program that wrote this file divided by zero"),
            );
            return None;
        }
        Some(number) => return Some(number),
        None => {}
    }
    let mut finding = Diagnostic::error(
        "not-a-number",
        format!("`{}` in `<{}>` is not a number", shortened(word), element.name),
    )
    .at(origin);
    if word.contains("${") || word.contains("$(") {
        finding = finding.help("this is a xacro expression: run xacro on the file first");
    } else if word.contains(',') {
        finding = finding.help("separate numbers by spaces and write a decimal point, not a comma");
    }
    diagnostics.push(finding);
    None
}

fn finite(number: f64, origin: Origin, element: &Element, diagnostics: &mut Diagnostics) -> bool {
    if !number.is_finite() {
        diagnostics.push(
            Diagnostic::error(
                "not-finite",
                format!("`<{}>` must be finite, not {}", element.name, format_number(number)),
            )
            .at(origin),
        );
    }
    number.is_finite()
}

/// Shortens a text for a message: a hostile word may have a megabyte.
pub(crate) fn shortened(word: &str) -> String {
    if word.chars().count() <= 60 {
        return word.to_owned();
    }
    word.chars().take(57).chain("...".chars()).collect()
}
