//! Inspection and conversion of map files.

use periplus_diagnostics::{RenderStyle, render as render_finding};
use periplus_grid::OccupancyGrid;
use periplus_maps::{Distro, Map, Wish, load, render};
use periplus_os::Machine;
use serde_json::json;

use super::save::write;
use crate::{Failure, Outcome, Session};

/// Loads a map and prints its findings.
pub(super) fn read(session: &mut Session<'_>, path: &str, distro: Distro) -> Outcome<Map> {
    let loaded = load(path, distro, &Machine);
    for finding in loaded.diagnostics.iter() {
        session.say(&render_finding(finding, &loaded.sources, RenderStyle::Colour));
    }
    let name = loaded.status.name();
    loaded.map.ok_or_else(|| Failure::failed(format!("cannot load the map `{path}` ({name})")))
}

/// Counts of free, occupied and unknown cells.
struct Shares {
    free: usize,
    occupied: usize,
    unknown: usize,
    between: usize,
}

impl Shares {
    fn of(map: &OccupancyGrid) -> Self {
        let mut shares = Self { free: 0, occupied: 0, unknown: 0, between: 0 };
        for cell in &map.cells {
            match cell {
                0 => shares.free += 1,
                100 => shares.occupied += 1,
                1..=99 => shares.between += 1,
                _ => shares.unknown += 1,
            }
        }
        shares
    }
}

/// Prints a summary of a map.
///
/// # Errors
/// When it cannot be loaded, or the output cannot be written.
pub fn info(session: &mut Session<'_>, path: &str, distro: Distro) -> Outcome {
    let map = read(session, path, distro)?;
    let info = map.grid.info;
    let shares = Shares::of(&map.grid);
    let (width_m, height_m) = info.size_m();
    let origin = info.origin;
    let description = &map.description;
    let (free, occupied) = (shares.free, shares.occupied);
    if session.json {
        return session.put(&json!({
            "yaml": path,
            "image": map.image_path.display().to_string(),
            "distro": distro.name(),
            "mode": description.mode.name(),
            "negate": description.negate,
            "occupied_thresh": description.occupied_thresh,
            "free_thresh": description.free_thresh,
            "resolution": info.resolution_m,
            "width": info.width,
            "height": info.height,
            "origin": [origin.x_m, origin.y_m, origin.yaw_rad],
            "cells": {
                "free": free, "occupied": occupied, "unknown": shares.unknown,
                "between": shares.between,
            },
        }));
    }
    let percent = |count: usize| 100.0 * count as f64 / info.len().max(1) as f64;
    let (low, high) = (info.point_at(0.0, 0.0), {
        let (columns, rows) = (info.width as f64, info.height as f64);
        info.point_at(columns, rows)
    });
    let negated = if description.negate { ", negated" } else { "" };
    let out = &mut session.out;
    writeln!(out, "picture     {}", map.image_path.display())?;
    writeln!(
        out,
        "size        {} x {} cells of {} m: {width_m:.2} x {height_m:.2} m",
        info.width, info.height, info.resolution_m
    )?;
    writeln!(
        out,
        "origin      x {} m, y {} m, yaw {} rad",
        origin.x_m, origin.y_m, origin.yaw_rad
    )?;
    writeln!(out, "corners     ({:.2}, {:.2}) to ({:.2}, {:.2}) m", low.0, low.1, high.0, high.1)?;
    writeln!(
        out,
        "mode        {}{negated}, free up to {}, occupied from {} ({} rules)",
        description.mode.name(),
        description.free_thresh,
        description.occupied_thresh,
        distro.name()
    )?;
    for (name, count) in [
        ("free", free),
        ("occupied", occupied),
        ("between", shares.between),
        ("unknown", shares.unknown),
    ] {
        if count > 0 || name != "between" {
            writeln!(out, "{name:<11} {count} cells ({:.1} %)", percent(count))?;
        }
    }
    out.flush()?;
    Ok(())
}

/// Options of a conversion.
#[derive(Clone, Debug, PartialEq)]
pub struct Convert {
    /// YAML file of the map.
    pub path: String,
    /// Distribution whose rules apply to it.
    pub from: Distro,
    /// Output settings; the name must not be empty.
    pub wish: Wish,
    /// Distribution of the map saver to follow.
    pub to: Distro,
}

/// Loads a map and saves it in another format or mode.
///
/// # Errors
/// When it cannot be loaded, the thresholds are invalid, or the files cannot be written.
pub fn convert(session: &mut Session<'_>, convert: &Convert) -> Outcome {
    let map = read(session, &convert.path, convert.from)?;
    let settled = convert.wish.settle(convert.to, 0);
    let (saving, said) = settled.map_err(|error| Failure::Usage(error.to_string()))?;
    for words in said {
        session.say(&format!("WARNING: {words}"));
    }
    write(session, &render(&map.grid, &saving), &Machine)
}
