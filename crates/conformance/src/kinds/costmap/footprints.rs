//! Outlines of robots.

use periplus_base::Pose2;
use periplus_costmap::{Costmap, Footprint, footprint};

use super::super::Setting;
use super::{costmap_of, number, points_of, pose_of, window_of};
use crate::{Case, Differences, Reader, Unreadable};

/// Kind `footprint`: corners and radii.
pub(in super::super) fn check_footprint(
    case: &Case,
    _distro: &str,
    _setting: &Setting<'_>,
    differences: &mut Differences,
) -> Result<(), Unreadable> {
    let (given, expect) = (case.given(), case.expect());
    let radius_m = number(&given, "robot_radius", 0.1)?;
    let read = match (given.find("points"), given.find("footprint")) {
        (Some(points), _) => Ok(Footprint::new(points_of(&points)?)),
        (None, Some(text)) => match text.text() {
            Ok("" | "[]") => Ok(Footprint::circle(radius_m)),
            Ok(text) => Footprint::read(text),
            Err(_) => Ok(Footprint::new(points_of(&text)?)),
        },
        (None, None) => Ok(Footprint::circle(radius_m)),
    };
    for name in ["valid", "accepted", "parsed", "success"] {
        if let Some(valid) = expect.find(name) {
            differences.same(name, &read.is_ok(), &valid.truth()?);
        }
    }
    // What cannot be read gives way to the circle.
    let outline = read.unwrap_or_else(|_| Footprint::circle(radius_m));
    let outline = match given.find("footprint_padding").or(given.find("padding")) {
        Some(padding) => outline.padded(padding.number()?),
        None => outline,
    };
    let corners = match given.find("pose") {
        Some(pose) => outline.placed(pose_of(&pose)?),
        None => outline.points().to_vec(),
    };
    if let Some(count) = expect.find("count") {
        differences.same("corners", &corners.len(), &count.count()?);
    }
    for name in ["points", "transformed"] {
        let Some(points) = expect.find(name) else { continue };
        let expected = points_of(&points)?;
        differences.same("corners", &corners.len(), &expected.len());
        for (at, (got, expected)) in corners.iter().zip(&expected).enumerate() {
            differences.all_near(format_args!("corner {at}"), got, expected);
        }
    }
    let radii = footprint::radii(outline.points());
    for (names, got) in [
        (["inscribed", "inscribed_radius"], radii.0),
        (["circumscribed", "circumscribed_radius"], radii.1),
    ] {
        let Some(expected) = expect.find(names[0]).or(expect.find(names[1])) else { continue };
        match expected.text() {
            Ok("DBL_MAX") => differences.same(names[0], &got, &f64::MAX),
            _ => differences.near(names[0], got, expected.number()?),
        }
    }
    Ok(())
}

/// Kinds `footprint_cost` and `collision_checker_topic`: the cost under an outline.
pub(in super::super) fn check_cost(
    case: &Case,
    _distro: &str,
    _setting: &Setting<'_>,
    differences: &mut Differences,
) -> Result<(), Unreadable> {
    let (given, expect) = (case.given(), case.expect());
    let costmap = draw(&given)?;
    let outline = given.find("footprint").map(|it| points_of(&it)).transpose()?;
    let cost = |pose: Pose2| match &outline {
        Some(points) => Footprint::new(points.clone()).cost(&costmap, pose),
        None => costmap.cost_at(pose.x_m, pose.y_m).unwrap_or(254),
    };
    let poses = given.get("poses").or(given.get("points"))?.each(pose_of)?;
    if let Some(costs) = expect.find("cost").or(expect.find("costs")) {
        let costs = costs.numbers()?;
        differences.same("costs", &costs.len(), &poses.len());
        for (pose, expected) in poses.iter().zip(costs) {
            differences.near(format_args!("cost at {pose:?}"), cost(*pose).into(), expected);
        }
    }
    for name in ["collision_free", "is_collision_free", "free", "collision"] {
        let Some(expected) = expect.find(name) else { continue };
        let expected = expected.each(Reader::truth)?;
        for (pose, expected) in poses.iter().zip(expected) {
            // Unknown counts as a collision, as lethal does.
            let is_free = cost(*pose) < 254;
            let got = if name == "collision" { !is_free } else { is_free };
            differences.same(format_args!("{name} at {pose:?}"), &got, &expected);
        }
    }
    Ok(())
}

/// A grid with some cells set.
fn draw(given: &Reader<'_>) -> Result<Costmap, Unreadable> {
    let mut costmap = costmap_of(given, "default")?;
    if let Some(window) = given.find("free_box_cells") {
        fill(&mut costmap, &window, 0)?;
    }
    if let Some(window) = given.find("lethal_box_cells") {
        fill(&mut costmap, &window, 254)?;
    }
    if let Some(cells) = given.find("lethal_cells") {
        for cell in cells.each(Reader::cell)? {
            costmap.set(cell, 254);
        }
    }
    for name in ["cells", "set", "set_cells"] {
        let Some(cells) = given.find(name) else { continue };
        for cell in cells.list()? {
            match *cell.each(Reader::count)?.as_slice() {
                [x, y, cost @ 0..=255] => costmap.set((x, y), cost as u8),
                _ => return Err(cell.unreadable("a column, a row and a cost")),
            }
        }
    }
    Ok(costmap)
}

/// Boxes are given with their last cells.
fn fill(costmap: &mut Costmap, window: &Reader<'_>, cost: u8) -> Result<(), Unreadable> {
    let window = window_of(window)?;
    for y in window.y0..=window.yn {
        for x in window.x0..=window.xn {
            costmap.set((x, y), cost);
        }
    }
    Ok(())
}
