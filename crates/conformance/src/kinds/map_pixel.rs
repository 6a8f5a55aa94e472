//! From pixels to occupancy.

use periplus_maps::{Distro, Mode, Rule};
use periplus_pictures::Layout;

use super::Setting;
use crate::{Case, Differences, Reader, Unreadable};

/// The rules of a distribution by its name.
pub(super) fn distro_of(case: &Case, name: &str) -> Result<Distro, Unreadable> {
    Distro::from_name(name).ok_or_else(|| {
        Unreadable(format!("{} names the distribution `{name}`, which nobody knows", case.id))
    })
}

/// Mode, thresholds and negation, where they are given.
pub(super) fn rule_of(given: &Reader<'_>, distro: Distro) -> Result<Rule, Unreadable> {
    let mode = match given.find("mode") {
        Some(name) => Mode::from_name(name.text()?).ok_or_else(|| name.unreadable("a mode"))?,
        None => Mode::Trinary,
    };
    let number = |name: &str, usual: f64| given.find(name).map_or(Ok(usual), |it| it.number());
    Ok(Rule {
        distro,
        mode,
        negate: given.find("negate").map_or(Ok(false), |it| it.truth())?,
        occupied_thresh: number("occupied_thresh", 0.65)?,
        free_thresh: number("free_thresh", 0.196)?,
    })
}

/// Pixels that are given, and how many samples each has.
fn pixels(given: &Reader<'_>) -> Result<(Layout, Vec<Vec<u8>>), Unreadable> {
    let bytes = |list: &Reader<'_>| list.each(Reader::byte);
    if let Some(list) = given.find("pixels") {
        let first = list.list()?.first().is_some_and(|pixel| pixel.value().is_array());
        if !first {
            return Ok((Layout::Grey, list.each(|pixel| Ok(vec![pixel.byte()?]))?));
        }
        let pixels = list.each(bytes)?;
        let layout = match pixels.first().map_or(0, Vec::len) {
            1 => Layout::Grey,
            2 => Layout::GreyAlpha,
            3 => Layout::Rgb,
            4 => Layout::Rgba,
            _ => return Err(list.unreadable("pixels of 1 to 4 samples")),
        };
        return Ok((layout, pixels));
    }
    for (name, layout) in
        [("gray_alpha", Layout::GreyAlpha), ("rgb", Layout::Rgb), ("rgba", Layout::Rgba)]
    {
        if let Some(list) = given.find(name) {
            let pixels = list.each(bytes)?;
            if let Some(odd) = pixels.iter().find(|pixel| pixel.len() != layout.channels()) {
                return Err(
                    list.unreadable(&format!("pixels of {}, not {odd:?}", layout.channels()))
                );
            }
            return Ok((layout, pixels));
        }
    }
    Err(Unreadable("`given` has no `pixels`, `gray_alpha`, `rgb` or `rgba`".into()))
}

/// What pixels mean, or how bright they are.
pub(super) fn check(
    case: &Case,
    distro: &str,
    _setting: &Setting<'_>,
    differences: &mut Differences,
) -> Result<(), Unreadable> {
    let (given, expect) = (case.given(), case.expect());
    let rule = rule_of(&given, distro_of(case, distro)?)?;
    let (layout, pixels) = pixels(&given)?;
    if let Some(expected) = expect.find("occupancy") {
        let expected = expected.each(Reader::integer)?;
        differences.same("number of cells", &pixels.len(), &expected.len());
        for (pixel, expected) in pixels.iter().zip(expected) {
            let got = i64::from(rule.occupancy(layout, pixel));
            differences.whole(format_args!("pixel {pixel:?}"), got, expected);
        }
    }
    if let Some(expected) = expect.find("gray") {
        let expected = expected.each(Reader::integer)?;
        differences.same("number of greys", &pixels.len(), &expected.len());
        for (pixel, expected) in pixels.iter().zip(expected) {
            let got = i64::from(rule.grey(layout, pixel));
            differences.whole(format_args!("grey of {pixel:?}"), got, expected);
        }
    }
    Ok(())
}
