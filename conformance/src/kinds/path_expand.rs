//! `~/` in paths.

use periplus_maps::expand_home;
use serde_json::json;

use super::Setting;
use crate::{Case, Differences, Unreadable};

/// Pairs of a path and a home.
pub(super) fn check(
    case: &Case,
    _distro: &str,
    _setting: &Setting<'_>,
    differences: &mut Differences,
) -> Result<(), Unreadable> {
    let paths = case.given().get("pairs")?.each(|pair| {
        let [path, home] = pair.each(|it| it.text())?[..] else {
            return Err(pair.unreadable("a path and a home"));
        };
        Ok(expand_home(path, home))
    })?;
    differences.compare_members(&[(&["paths"], json!(paths))], &case.expect());
    Ok(())
}
