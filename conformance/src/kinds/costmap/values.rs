//! Meaning of values: of maps, of masks, of distances.

use periplus_costmap::inflation::CostTable;
use periplus_costmap::layers::MapMeaning;
use periplus_costmap::{Footprint, Nav2Release, cost, tables};
use serde_json::json;

use super::super::Setting;
use super::{compat_of, points_of, values_of};
use crate::{Case, CaseReader, Differences, Unreadable, number};

fn occupancy(it: &CaseReader<'_>) -> Result<i8, Unreadable> {
    i8::try_from(it.integer()?).map_err(|_| it.unreadable("a number from -128 to 127"))
}

/// A list under the first of some names that is there.
fn list<'v>(reader: &CaseReader<'v>, names: &[&str]) -> Result<CaseReader<'v>, Unreadable> {
    reader.get_any(names)
}

/// Kind `static_layer_value`: costs of a map's cells.
pub(in super::super) fn check_static(
    case: &Case,
    distro: &str,
    _setting: &Setting<'_>,
    differences: &mut Differences,
) -> Result<(), Unreadable> {
    let (given, expect) = (case.given(), case.expect());
    let values = values_of(&tables::COSTMAP, &[], given.find("params").as_ref())?;
    let meaning = MapMeaning::read(&values, compat_of(distro)?);
    let occupancies = list(&given, &["occupancy", "values", "data"])?.each(occupancy)?;
    let got: Vec<u8> = occupancies.iter().map(|occupancy| meaning.cost(*occupancy)).collect();
    differences.compare_members(&[(&["cost", "costs", "values", "data"], json!(got))], &expect);
    Ok(())
}

/// Kinds `occgrid_to_costmap` and `mask_cost`.
pub(in super::super) fn check_to_cost(
    case: &Case,
    _distro: &str,
    _setting: &Setting<'_>,
    differences: &mut Differences,
) -> Result<(), Unreadable> {
    let (given, expect) = (case.given(), case.expect());
    let names = ["occupancy", "mask", "mask_values", "values", "data"];
    let occupancies = list(&given, &names)?.each(occupancy)?;
    let got: Vec<u8> = occupancies.iter().map(|occupancy| cost::cost_of(*occupancy)).collect();
    differences.compare_members(&[(&["cost", "costs", "values", "data"], json!(got))], &expect);
    Ok(())
}

/// Kind `costmap_to_occgrid`.
pub(in super::super) fn check_to_occupancy(
    case: &Case,
    _distro: &str,
    _setting: &Setting<'_>,
    differences: &mut Differences,
) -> Result<(), Unreadable> {
    let (given, expect) = (case.given(), case.expect());
    let costs = list(&given, &["cost", "costs", "values", "data"])?.each(CaseReader::byte)?;
    let got: Vec<i8> = costs.iter().map(|cost| cost::occupancy_of(*cost)).collect();
    differences.compare_members(&[(&["occupancy", "values", "data"], json!(got))], &expect);
    Ok(())
}

/// Kind `inflation_cost`: costs by distance.
pub(in super::super) fn check_inflation(
    case: &Case,
    distro: &str,
    _setting: &Setting<'_>,
    differences: &mut Differences,
) -> Result<(), Unreadable> {
    let (given, expect) = (case.given(), case.expect());
    let radius_m = super::number(&given, "robot_radius", 0.1)?;
    let footprint = match given.find_any(&["footprint_unpadded", "footprint"]) {
        Some(points) => Footprint::new(points_of(&points)?),
        None => Footprint::circle(radius_m),
    };
    let footprint = footprint.padded(super::number(&given, "footprint_padding", 0.0)?);
    let inscribed_m = super::number(&given, "inscribed_radius", footprint.inscribed_radius_m)?;
    let resolution_m = given.get("resolution")?.number()?;
    let table = |compat: Nav2Release| -> Result<CostTable, Unreadable> {
        Ok(CostTable::new(
            resolution_m,
            given.get("inflation_radius")?.number()?,
            inscribed_m,
            given.get("cost_scaling_factor")?.number()?,
            compat,
        ))
    };
    let (rounded, exact) = (table(Nav2Release::Main)?, table(Nav2Release::Humble)?);
    // Both are known whatever the distribution; the one that it uses is `table`.
    let used = table(compat_of(distro)?)?;
    for (name, expected) in expect.members()? {
        match name {
            "inscribed_radius" => differences.compare(name, &number(inscribed_m), &expected),
            "cell_inflation_radius" => {
                differences.compare(name, &json!(rounded.radius_cells()), &expected);
            }
            "offsets" => {
                for offset in expected.distinct()? {
                    let part = |name: &str| offset.get(name)?.input().integer();
                    let (dx, dy) = (part("dx")?, part("dy")?);
                    let square = dx.checked_mul(dx).zip(dy.checked_mul(dy));
                    let square = square.and_then(|(x, y)| u32::try_from(x.checked_add(y)?).ok());
                    let square = square.ok_or_else(|| offset.unreadable("near"))?;
                    let got = json!({
                        "dx": dx, "dy": dy,
                        "cost_main": rounded.cost(square),
                        "cost_exact": exact.cost(square),
                        "cost": used.cost(square),
                    });
                    differences.compare(format_args!("at ({dx}, {dy})"), &got, &offset);
                }
            }
            _ => differences.not_known(format!("`{}`", expected.path())),
        }
    }
    Ok(())
}
