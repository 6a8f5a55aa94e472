//! The colours of maps.

use periplus_maps::palette::Scheme;
use serde_json::json;

use super::Setting;
use crate::{Case, Differences, Unreadable};

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
    let colours: Vec<&[u8]> = palette.iter().map(<[u8; 4]>::as_slice).collect();
    differences.compare_members(&[(&["rgba"], json!(colours))], &case.expect());
    Ok(())
}
