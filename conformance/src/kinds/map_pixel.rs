//! From pixels to occupancy.

use periplus_images::Layout;
use periplus_maps::{Distro, Mode, Rule};
use serde_json::json;

use super::Setting;
use crate::{Case, CaseReader, Differences, Unreadable};

/// The rules of a distribution by its name.
pub(super) fn distro_of(case: &Case, name: &str) -> Result<Distro, Unreadable> {
    // A release of a distribution is named after it.
    let distro = name.split('-').next().unwrap_or_default();
    Distro::from_name(distro)
        .ok_or_else(|| Unreadable(format!("{} names the unknown distribution `{name}`", case.id)))
}

/// Mode, thresholds and negation, where they are given.
pub(super) fn rule_of(given: &CaseReader<'_>, distro: Distro) -> Result<Rule, Unreadable> {
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
fn pixels(given: &CaseReader<'_>) -> Result<(Layout, Vec<Vec<u8>>), Unreadable> {
    let bytes = |list: &CaseReader<'_>| list.each(CaseReader::byte);
    if let Some(list) = given.find("pixels") {
        let first = list.list()?.first().is_some_and(|pixel| pixel.raw().is_array());
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

/// Cell values of pixels, or their grey values.
pub(super) fn check(
    case: &Case,
    distro: &str,
    _setting: &Setting<'_>,
    differences: &mut Differences,
) -> Result<(), Unreadable> {
    let (given, expect) = (case.given(), case.expect());
    let rule = rule_of(&given, distro_of(case, distro)?)?;
    let (layout, pixels) = pixels(&given)?;
    let occupancy: Vec<i8> = pixels.iter().map(|pixel| rule.occupancy(layout, pixel)).collect();
    let grey: Vec<u8> = pixels.iter().map(|pixel| rule.grey(layout, pixel)).collect();
    differences.compare_members(
        &[(&["occupancy"], json!(occupancy)), (&["gray", "grey"], json!(grey))],
        &expect,
    );
    Ok(())
}
