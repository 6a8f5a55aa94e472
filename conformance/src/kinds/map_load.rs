//! Loading map files.

use periplus_diagnostics::{Diagnostics, SourceMap};
use periplus_geometry::{Pose, Pose2};
use periplus_images::Raster;
use periplus_maps::{Description, Distro, grid_of, load, read_description};
use serde_json::{Value, json};

use super::Setting;
use super::map_pixel::{distro_of, rule_of};
use crate::{Case, CaseReader, Differences, Unreadable, number, numbers};

/// A picture with what its YAML would say, or paths of YAMLs and how loading each ends.
pub(super) fn check(
    case: &Case,
    distro: &str,
    setting: &Setting<'_>,
    differences: &mut Differences,
) -> Result<(), Unreadable> {
    let given = case.given();
    if given.find("inputs").is_some() {
        ends(case, distro, setting, differences)
    } else if let Some(yaml) = given.find_any(&["yaml", "yaml_text"]) {
        values(case, &yaml, distro, differences)
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
    differences.compare_members(
        &[(&["result"], json!(names)), (&["service_code"], json!(codes))],
        &expect,
    );
    Ok(())
}

/// Values of a map's YAML file; an error if it cannot be used.
fn values(
    case: &Case,
    yaml: &CaseReader<'_>,
    distro: &str,
    differences: &mut Differences,
) -> Result<(), Unreadable> {
    let found = values_of_yaml(yaml.text()?, distro_of(case, distro)?);
    let is_valid = json!(found.is_some());
    let mut got = found.unwrap_or_else(|| json!({}));
    got["valid"] = is_valid.clone();
    got["success"] = is_valid;
    differences.compare("", &got, &case.expect());
    Ok(())
}

/// The values of a map's YAML; none if it cannot be used.
pub(super) fn values_of_yaml(yaml: &str, distro: Distro) -> Option<Value> {
    let mut sources = SourceMap::new();
    let file = sources.add("map.yaml", yaml);
    let found = read_description(file, &sources, distro, &mut Diagnostics::new())?;
    let origin = found.origin;
    Some(json!({
        "image": found.image,
        "resolution": number(found.resolution_m),
        "origin": numbers([origin.x_m, origin.y_m, origin.yaw_rad]),
        "negate": u8::from(found.negate),
        "occupied_thresh": number(found.occupied_thresh),
        "free_thresh": number(found.free_thresh),
        "mode": found.mode.name(),
    }))
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
    let info = grid.info;
    let rotation = Pose::from(info.origin).rotation;
    let origin = info.origin;
    differences.compare_members(
        &[
            (&["width"], json!(info.width)),
            (&["height"], json!(info.height)),
            (&["resolution"], number(info.resolution_m)),
            (&["data"], json!(grid.cells)),
            (&["origin"], numbers([origin.x_m, origin.y_m, origin.yaw_rad])),
            (&["origin_quaternion_z_w"], numbers([rotation.z, rotation.w])),
        ],
        &expect,
    );
    Ok(())
}
