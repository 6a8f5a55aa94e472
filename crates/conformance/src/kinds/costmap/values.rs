//! What numbers mean: of maps, of masks, of distances.

use periplus_costmap::inflation::CostTable;
use periplus_costmap::layers::MapMeaning;
use periplus_costmap::{Compat, Footprint, cost, tables};

use super::super::Setting;
use super::{compat_of, number, points_of, values_of};
use crate::{Case, Differences, Reader, Unreadable};

fn occupancy(it: &Reader<'_>) -> Result<i8, Unreadable> {
    i8::try_from(it.integer()?).map_err(|_| it.unreadable("a number from -128 to 127"))
}

/// A list under the first of some names that is there.
fn list<'v>(reader: &Reader<'v>, names: &[&str]) -> Result<Reader<'v>, Unreadable> {
    let found = names.iter().find_map(|name| reader.find(name));
    found.ok_or_else(|| reader.unreadable(&format!("one that has `{}`", names.join("` or `"))))
}

/// Kind `static_layer_value`: costs of a map's cells.
pub(in super::super) fn check_static(
    case: &Case,
    distro: &str,
    _setting: &Setting<'_>,
    differences: &mut Differences,
) -> Result<(), Unreadable> {
    let (given, expect) = (case.given(), case.expect());
    let values = values_of(&tables::COSTMAP, given.find("params").as_ref())?;
    let meaning = MapMeaning::read(&values, compat_of(distro));
    let occupancies = given.get("occupancy")?.each(occupancy)?;
    let costs = expect.get("cost")?.each(Reader::integer)?;
    differences.same("costs", &costs.len(), &occupancies.len());
    for (occupancy, expected) in occupancies.iter().zip(costs) {
        let got = meaning.cost(*occupancy).into();
        differences.whole(format_args!("cost of {occupancy}"), got, expected);
    }
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
    let costs = list(&expect, &["cost", "costs", "values", "data"])?.each(Reader::integer)?;
    differences.same("costs", &costs.len(), &occupancies.len());
    for (occupancy, expected) in occupancies.iter().zip(costs) {
        let got = cost::cost_of(*occupancy).into();
        differences.whole(format_args!("cost of {occupancy}"), got, expected);
    }
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
    let costs = list(&given, &["cost", "costs", "values", "data"])?.each(Reader::byte)?;
    let names = ["occupancy", "values", "data"];
    let occupancies = list(&expect, &names)?.each(Reader::integer)?;
    differences.same("occupancies", &occupancies.len(), &costs.len());
    for (cost, expected) in costs.iter().zip(occupancies) {
        let got = cost::occupancy_of(*cost).into();
        differences.whole(format_args!("occupancy of {cost}"), got, expected);
    }
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
    let footprint = match given.find("footprint_unpadded").or(given.find("footprint")) {
        Some(points) => Footprint::new(points_of(&points)?),
        None => Footprint::circle(number(&given, "robot_radius", 0.1)?),
    };
    let footprint = footprint.padded(number(&given, "footprint_padding", 0.0)?);
    let inscribed_m = number(&given, "inscribed_radius", footprint.inscribed_radius_m)?;
    let resolution_m = given.get("resolution")?.number()?;
    let table = |compat: Compat| -> Result<CostTable, Unreadable> {
        Ok(CostTable::new(
            resolution_m,
            given.get("inflation_radius")?.number()?,
            inscribed_m,
            given.get("cost_scaling_factor")?.number()?,
            compat,
        ))
    };
    let (rounded, exact) = (table(Compat::Main)?, table(Compat::Humble)?);
    if let Some(expected) = expect.find("inscribed_radius") {
        differences.near("inscribed radius", inscribed_m, expected.number()?);
    }
    if let Some(expected) = expect.find("cell_inflation_radius") {
        let got = i64::from(rounded.radius_cells());
        differences.whole("radius in cells", got, expected.integer()?);
    }
    for offset in expect.get("offsets")?.list()? {
        let (dx, dy) = (offset.get("dx")?.integer()?, offset.get("dy")?.integer()?);
        let square = u32::try_from(dx * dx + dy * dy).map_err(|_| offset.unreadable("near"))?;
        // Both are known whatever the distribution; the one that it uses is `table`.
        let used = table(compat_of(distro))?.cost(square);
        let pairs = [
            ("cost_main", rounded.cost(square)),
            ("cost_exact", exact.cost(square)),
            ("cost", used),
        ];
        for (name, got) in pairs {
            if let Some(expected) = offset.find(name) {
                let what = format_args!("{name} at ({dx}, {dy})").to_string();
                differences.whole(what, got.into(), expected.integer()?);
            }
        }
    }
    Ok(())
}
