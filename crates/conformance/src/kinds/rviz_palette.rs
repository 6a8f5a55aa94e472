//! The colours of maps.

use periplus_maps::palette::Scheme;

use super::Setting;
use crate::{Case, Differences, Reader, Unreadable};

/// A colour for each value.
pub(super) fn check(
    case: &Case,
    _distro: &str,
    _setting: &Setting<'_>,
    differences: &mut Differences,
) -> Result<(), Unreadable> {
    let given = case.given();
    let name = given.get("scheme")?;
    let scheme = Scheme::from_name(name.text()?)
        .ok_or_else(|| name.unreadable("`map`, `costmap` or `raw`"))?;
    let palette = match given.find("binary_threshold") {
        Some(threshold) => scheme.binary(threshold.byte()?),
        None => scheme.palette(),
    };
    let expected = case.expect().get("rgba")?.each(|colour| colour.each(Reader::byte))?;
    differences.same("number of colours", &palette.len(), &expected.len());
    for (value, (got, expected)) in palette.iter().zip(&expected).enumerate() {
        differences.same(format_args!("colour of {value}"), got.as_slice(), expected);
    }
    Ok(())
}
