//! `~/` in paths.

use periplus_maps::expand_home;

use super::Setting;
use crate::{Case, Differences, Unreadable};

/// Pairs of a path and a home.
pub(super) fn check(
    case: &Case,
    _distro: &str,
    _setting: &Setting<'_>,
    differences: &mut Differences,
) -> Result<(), Unreadable> {
    let (pairs, paths) = (case.given().get("pairs")?, case.expect().get("paths")?);
    differences.same("number of paths", &pairs.list()?.len(), &paths.list()?.len());
    for (pair, expected) in pairs.list()?.iter().zip(paths.list()?) {
        let [path, home] = pair.each(|it| it.text())?[..] else {
            return Err(pair.unreadable("a path and a home"));
        };
        differences.same(
            format_args!("`{path}` at `{home}`"),
            expand_home(path, home).as_str(),
            expected.text()?,
        );
    }
    Ok(())
}
