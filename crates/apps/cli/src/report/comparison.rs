//! Difference of two recordings: their maps and paths.

use std::fmt::Write as _;

use periplus_grid::Grid;
use periplus_session::difference::{MapCellState, MapDifference, RecordingDifference};

use super::html::{Section, paragraph};
use super::map::{NamedPath, figure, image, paths, picture_of_colours};
use super::plot::{Curve, Plot};
use super::{OpenRun, row};
use crate::error::CliError;
use crate::report::html::table;

/// Colours of cells; a cell that only one map knows is paler.
const UNKNOWN_COLOUR: [u8; 3] = [205, 205, 205];
const FREE_COLOUR: [u8; 3] = [255, 255, 255];
const WALL_COLOUR: [u8; 3] = [40, 40, 40];
const ONLY_FIRST_COLOUR: [u8; 3] = [150, 185, 245];
const ONLY_SECOND_COLOUR: [u8; 3] = [250, 200, 140];
const NEW_WALL_COLOUR: [u8; 3] = [200, 90, 0];
const LOST_WALL_COLOUR: [u8; 3] = [11, 87, 208];

pub(super) fn section(first: &OpenRun, second: &OpenRun) -> Result<Section, CliError> {
    let difference = RecordingDifference::of(&first.bag, &second.bag)?;
    let mut body = String::new();
    match &difference.map {
        Some(map) => body.push_str(&map_figure(map)),
        None => {
            body.push_str(&paragraph("The maps are not compared: one of the recordings has none."));
        }
    }
    match &difference.trajectory {
        Some(trajectory) => {
            let since = if trajectory.is_since_start {
                " The recordings are of different times; times since their starts are compared."
            } else {
                ""
            };
            body.push_str(&paragraph(&format!(
                "Distance between the robots in `{}`: {:.3} m RMS, {:.3} m at most.{since}",
                trajectory.frame, trajectory.rms_m, trajectory.max_m
            )));
            let plot = Plot {
                title: "Distance between the robots of A and B".into(),
                unit: "m",
                curves: vec![Curve {
                    name: "distance".into(),
                    points: trajectory.distances_m.clone(),
                }],
            };
            let figure = plot.figure().unwrap_or_default();
            body.push_str(&format!("<div class=\"figures\">{figure}</div>\n"));
        }
        None => body.push_str(&paragraph(
            "The paths are not compared: the recordings have no transform to the robot in common.",
        )),
    }
    let both: Vec<NamedPath> = [(first, 0), (second, 1)]
        .into_iter()
        .filter_map(|(run, colour)| {
            let path = paths(run).into_iter().next()?;
            Some(NamedPath { name: format!("{}: {}", run.label, path.name), colour, ..path })
        })
        .collect();
    if !both.is_empty() {
        body.push_str("<h3>Both paths</h3>\n");
        body.push_str(&figure(None, &both, &[]));
    }
    Ok(Section { title: "Difference".to_owned(), body })
}

fn map_figure(map: &MapDifference) -> String {
    let ratio = 100.0 * map.changed_count as f64 / (map.known_count.max(1) as f64);
    let mut rows = row("Cells that both maps know", &map.known_count.to_string());
    rows.push_str(&row(
        "Of these free in one and a wall in the other",
        &format!("{} ({ratio:.2} %)", map.changed_count),
    ));
    rows.push_str(&row("Cells that only A knows", &map.only_first_count.to_string()));
    rows.push_str(&row("Cells that only B knows", &map.only_second_count.to_string()));
    let info = map.cells.info;
    let mut colours = Grid::new(info, UNKNOWN_COLOUR);
    for index in 0..info.len() {
        let cell = info.cell(index);
        colours[cell] = match map.cells[cell] {
            (MapCellState::Unknown, MapCellState::Unknown) => UNKNOWN_COLOUR,
            (MapCellState::Wall, MapCellState::Wall) => WALL_COLOUR,
            (MapCellState::Free, MapCellState::Free) => FREE_COLOUR,
            (MapCellState::Free, MapCellState::Wall)
            | (MapCellState::Unknown, MapCellState::Wall) => NEW_WALL_COLOUR,
            (MapCellState::Wall, MapCellState::Free)
            | (MapCellState::Wall, MapCellState::Unknown) => LOST_WALL_COLOUR,
            (MapCellState::Free, MapCellState::Unknown) => ONLY_FIRST_COLOUR,
            (MapCellState::Unknown, MapCellState::Free) => ONLY_SECOND_COLOUR,
        };
    }
    let size = (info.width as f64, info.height as f64);
    let mut out = table(&format!("Maps, on cells of {} m", info.resolution_m), &[], &rows);
    let _ = writeln!(
        out,
        "<figure><svg class=\"floor\" viewBox=\"0 0 {} {}\" role=\"img\" aria-label=\"Difference of the maps from above: \
         {} cells are free in one map and a wall in the other\">{}</svg><figcaption>Black: walls of both; white: free in \
         both; orange: walls that only B has (pale: free, only B knows the cell); blue: walls that only A has (pale: free, \
         only A knows the cell).</figcaption></figure>",
        size.0,
        size.1,
        map.changed_count,
        image(&picture_of_colours(&colours), size, "difference")
    );
    out
}
