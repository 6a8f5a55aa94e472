//! Loading map files.

use periplus_base::{Pose, Pose2};
use periplus_maps::{Description, grid_of, load};
use periplus_pictures::Raster;

use super::Setting;
use super::map_pixel::{distro_of, rule_of};
use crate::{Case, Differences, Reader, Unreadable};

/// A picture with what its YAML would say, or paths of YAMLs and how loading each ends.
pub(super) fn check(
    case: &Case,
    distro: &str,
    setting: &Setting<'_>,
    differences: &mut Differences,
) -> Result<(), Unreadable> {
    if case.given().find("inputs").is_some() {
        ends(case, distro, setting, differences)
    } else {
        cells(case, distro, setting, differences)
    }
}

fn ends(
    case: &Case,
    distro: &str,
    setting: &Setting<'_>,
    differences: &mut Differences,
) -> Result<(), Unreadable> {
    let (given, expect) = (case.given(), case.expect());
    let inputs = given.get("inputs")?.list()?;
    let distro = distro_of(case, distro)?;
    let (mut names, mut codes) = (Vec::new(), Vec::new());
    for input in &inputs {
        // Behind a blank is a remark.
        let name = input.text()?.split(' ').next().unwrap_or_default();
        let path = setting.file(name).map_or(name.to_owned(), |path| path.display().to_string());
        let status = load(&path, distro, setting.host).status;
        names.push(status.name());
        codes.push(i64::from(status.code()));
    }
    if let Some(expected) = expect.find("result") {
        differences.same("results", &names, &expected.each(|it| it.text())?);
    }
    if let Some(expected) = expect.find("service_code") {
        differences.same("codes", &codes, &expected.each(Reader::integer)?);
    }
    Ok(())
}

fn cells(
    case: &Case,
    distro: &str,
    setting: &Setting<'_>,
    differences: &mut Differences,
) -> Result<(), Unreadable> {
    let (given, expect) = (case.given(), case.expect());
    let file = given.get("file")?;
    let path = setting.file(file.text()?).ok_or_else(|| file.unreadable("a file that is there"))?;
    let bytes = setting.host.read(&path).map_err(|error| Unreadable(error.to_string()))?;
    let distro = distro_of(case, distro)?;
    let rule = rule_of(&given, distro)?;
    let [x_m, y_m, yaw_rad] = given.get("origin")?.array()?;
    let description = Description {
        origin: Pose2::new(x_m, y_m, yaw_rad),
        occupied_thresh: rule.occupied_thresh,
        free_thresh: rule.free_thresh,
        negate: rule.negate,
        mode: rule.mode,
        ..Description::of_image(file.text()?, given.get("resolution")?.number()?)
    };
    let raster = match Raster::decode(&bytes) {
        Ok(raster) => raster.into_shallow(),
        Err(error) => {
            differences.push(error.to_string());
            return Ok(());
        }
    };
    let grid = match grid_of(&raster, &description, distro) {
        Ok(grid) => grid,
        Err(error) => {
            differences.push(error.to_string());
            return Ok(());
        }
    };
    let lattice = grid.lattice;
    for (name, got) in [("width", lattice.width), ("height", lattice.height)] {
        if let Some(expected) = expect.find(name) {
            differences.same(name, &got, &expected.count()?);
        }
    }
    if let Some(expected) = expect.find("resolution") {
        differences.near("resolution", lattice.resolution_m, expected.number()?);
    }
    if let Some(expected) = expect.find("data") {
        let got: Vec<i64> = grid.cells.iter().map(|&cell| i64::from(cell)).collect();
        let expected = expected.each(Reader::integer)?;
        differences.same("cells", &got.len(), &expected.len());
        for (index, (got, expected)) in got.iter().zip(expected).enumerate() {
            differences.whole(format_args!("cell {:?}", lattice.cell(index)), *got, expected);
        }
    }
    if let Some(expected) = expect.find("origin_quaternion_z_w") {
        let rotation = Pose::from(lattice.origin).rotation;
        differences.all_near("orientation", &[rotation.z, rotation.w], &expected.array::<2>()?);
    }
    Ok(())
}
