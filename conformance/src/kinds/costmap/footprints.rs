//! Outlines of robots.

use periplus_costmap::{Costmap, Footprint, footprint};
use periplus_geometry::Pose2;
use serde_json::{Value, json};

use super::super::Setting;
use super::{costmap_of, points_of, pose_of, window_of};
use crate::{Case, CaseReader, Differences, Unreadable, number, numbers};

/// Kind `footprint`: corners and radii.
pub(in super::super) fn check_footprint(
    case: &Case,
    _distro: &str,
    _setting: &Setting<'_>,
    differences: &mut Differences,
) -> Result<(), Unreadable> {
    let (given, expect) = (case.given(), case.expect());
    let radius_m = super::number(&given, "robot_radius", 0.1)?;
    let read = match (given.find("points"), given.find("footprint")) {
        (Some(points), _) => Ok(Footprint::new(points_of(&points)?)),
        (None, Some(text)) => match text.text() {
            Ok("" | "[]") => Ok(Footprint::circle(radius_m)),
            Ok(text) => Footprint::read(text),
            Err(_) => Ok(Footprint::new(points_of(&text)?)),
        },
        (None, None) => Ok(Footprint::circle(radius_m)),
    };
    let is_valid = read.is_ok();
    // What cannot be read gives way to the circle.
    let outline = read.unwrap_or_else(|_| Footprint::circle(radius_m));
    let outline = match given.find_any(&["footprint_padding", "padding"]) {
        Some(padding) => outline.padded(padding.number()?),
        None => outline,
    };
    let corners = match given.find("pose") {
        Some(pose) => outline.placed(pose_of(&pose)?),
        None => outline.points().to_vec(),
    };
    let radii = footprint::radii(outline.points());
    let points: Value = corners.iter().map(|corner| numbers(*corner)).collect();
    differences.compare_members(
        &[
            (&["valid", "accepted", "parsed", "success"], json!(is_valid)),
            (&["count"], json!(corners.len())),
            (&["points", "transformed"], points),
            (&["inscribed", "inscribed_radius"], number(radii.0)),
            (&["circumscribed", "circumscribed_radius"], number(radii.1)),
        ],
        &expect,
    );
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
    let poses = given.get_any(&["poses", "points"])?.each(pose_of)?;
    let costs: Vec<u8> = poses.iter().map(|pose| cost(*pose)).collect();
    // Unknown counts as a collision, as lethal does.
    let free: Vec<bool> = costs.iter().map(|cost| *cost < 254).collect();
    let collides: Vec<bool> = free.iter().map(|is_free| !is_free).collect();
    differences.compare_members(
        &[
            (&["cost", "costs"], numbers(costs.iter().map(|cost| f64::from(*cost)))),
            (&["collision_free", "is_collision_free", "free"], json!(free)),
            (&["collision"], json!(collides)),
        ],
        &expect,
    );
    Ok(())
}

/// A grid with some cells set.
fn draw(given: &CaseReader<'_>) -> Result<Costmap, Unreadable> {
    let mut costmap = costmap_of(given, "default")?;
    if let Some(window) = given.find("free_box_cells") {
        fill(&mut costmap, &window, 0)?;
    }
    if let Some(window) = given.find("lethal_box_cells") {
        fill(&mut costmap, &window, 254)?;
    }
    if let Some(cells) = given.find("lethal_cells") {
        for cell in cells.each(CaseReader::cell)? {
            costmap.set(cell, 254);
        }
    }
    for name in ["cells", "set", "set_cells"] {
        let Some(cells) = given.find(name) else { continue };
        for cell in cells.list()? {
            match *cell.each(CaseReader::count)?.as_slice() {
                [x, y, cost @ 0..=255] => costmap.set((x, y), cost as u8),
                _ => return Err(cell.unreadable("a column, a row and a cost")),
            }
        }
    }
    Ok(costmap)
}

/// Boxes are given with their last cells.
fn fill(costmap: &mut Costmap, window: &CaseReader<'_>, cost: u8) -> Result<(), Unreadable> {
    let window = window_of(window)?;
    for y in window.y0..=window.yn {
        for x in window.x0..=window.xn {
            costmap.set((x, y), cost);
        }
    }
    Ok(())
}
