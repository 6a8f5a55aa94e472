//! Comparison of two maps.

use std::path::{Path, PathBuf};

use periplus_images::{Layout, write_png};
use periplus_maps::{CompareOptions, Distro, MapComparison, Overlap, Walls, compare, picture};
use periplus_os::Machine;
use periplus_resources::Store as _;
use serde_json::{Value, json};

use super::files::read;
use crate::{Failure, Outcome, Session};

/// Options of a comparison.
#[derive(Clone, Debug, PartialEq)]
pub struct Diff {
    /// YAML file of the reference map.
    pub first: String,
    /// YAML file of the other map.
    pub other: String,
    /// Distribution whose rules apply to both.
    pub distro: Distro,
    /// Alignment options.
    pub options: CompareOptions,
    /// Path of an image of both maps.
    pub picture: Option<PathBuf>,
}

/// Compares two maps: their alignment, the overlap of their cells, and the distances between their
/// walls.
///
/// # Errors
/// When a map cannot be loaded, they are too far apart, or the output cannot be written.
pub fn diff(session: &mut Session<'_>, diff: &Diff) -> Outcome {
    let first = read(session, &diff.first, diff.distro)?;
    let other = read(session, &diff.other, diff.distro)?;
    let comparison = compare(&first.grid, &other.grid, diff.options)
        .map_err(|error| Failure::failed(format!("the maps cannot be aligned: {error}")))?;
    if let Some(path) = &diff.picture {
        draw(&comparison, path)?;
    }
    if session.json {
        return session.put(&to_json(&comparison));
    }
    tell(session, &comparison, diff.options.align)?;
    if let Some(path) = &diff.picture {
        session.say(&format!(
            "{} shows walls of both maps in black, of the first only in blue, of the other only in red",
            path.display()
        ));
    }
    Ok(())
}

fn draw(comparison: &MapComparison, path: &Path) -> Outcome {
    let (width, height, rgb) = picture(comparison);
    let png = write_png(width, height, Layout::Rgb, &rgb);
    Machine
        .replace(path, &png)
        .map_err(|words| Failure::failed(format!("cannot write `{}`: {words}", path.display())))
}

fn tell(session: &mut Session<'_>, comparison: &MapComparison, is_aligned: bool) -> Outcome {
    let out = &mut session.out;
    if is_aligned {
        let place = comparison.alignment.reference_from_other;
        writeln!(
            out,
            "alignment     x {:+.3} m, y {:+.3} m, yaw {:+.3} deg: {:.1} % of the walls match",
            place.x_m,
            place.y_m,
            place.yaw_rad.to_degrees(),
            100.0 * comparison.alignment.score
        )?;
    }
    writeln!(out, "              {:>8}  {:>9}  {:>9}  {:>9}", "IoU", "both", "first", "other")?;
    for (name, overlap) in overlaps(comparison) {
        let Overlap { both, first_only, other_only } = overlap;
        writeln!(
            out,
            "{name:<13} {:>8.4}  {both:>9}  {first_only:>9}  {other_only:>9}",
            overlap.iou()
        )?;
    }
    writeln!(
        out,
        "              {:>8}  {:>9}  {:>9}  {:>9}  {:>9}",
        "walls", "mean m", "median m", "95 % m", "most m"
    )?;
    for (name, walls) in distances(comparison) {
        writeln!(
            out,
            "{name:<13} {:>8}  {:>9.4}  {:>9.4}  {:>9.4}  {:>9.4}",
            walls.count, walls.mean_m, walls.median_m, walls.p95_m, walls.largest_m
        )?;
    }
    out.flush()?;
    Ok(())
}

fn overlaps(comparison: &MapComparison) -> [(&'static str, Overlap); 4] {
    [
        ("walls", comparison.walls),
        ("walls nearby", comparison.walls_nearby),
        ("free", comparison.free),
        ("known", comparison.known),
    ]
}

fn distances(comparison: &MapComparison) -> [(&'static str, Walls); 2] {
    [("first, other", comparison.first_to_other), ("other, first", comparison.other_to_first)]
}

fn to_json(comparison: &MapComparison) -> Value {
    let overlap = |it: Overlap| {
        json!({
            "iou": it.iou(), "both": it.both, "first_only": it.first_only,
            "other_only": it.other_only,
        })
    };
    // NaN becomes null.
    let walls = |it: Walls| {
        json!({
            "count": it.count, "mean_m": it.mean_m, "median_m": it.median_m, "p95_m": it.p95_m,
            "largest_m": it.largest_m,
        })
    };
    let place = comparison.alignment.reference_from_other;
    json!({
        "alignment": {
            "x_m": place.x_m, "y_m": place.y_m, "yaw_rad": place.yaw_rad,
            "score": comparison.alignment.score,
        },
        "walls": overlap(comparison.walls),
        "walls_nearby": overlap(comparison.walls_nearby),
        "free": overlap(comparison.free),
        "known": overlap(comparison.known),
        "first_to_other": walls(comparison.first_to_other),
        "other_to_first": walls(comparison.other_to_first),
    })
}
