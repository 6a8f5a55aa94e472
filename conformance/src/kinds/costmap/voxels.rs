//! Voxels.

use periplus_costmap::{MAX_VOXEL_COUNT, Voxel, VoxelGrid, VoxelLine};
use periplus_geometry::Pose2;
use periplus_grid::GridInfo;
use serde_json::{Value, json};

use super::super::Setting;
use crate::{Case, CaseReader, Differences, Expected, Unreadable};

/// Kind `voxel_grid`: marks, then clears, then what is left.
pub(in super::super) fn check(
    case: &Case,
    _distro: &str,
    _setting: &Setting<'_>,
    differences: &mut Differences,
) -> Result<(), Unreadable> {
    let (given, expect) = (case.given(), case.expect());
    let size = given.get("size")?;
    let (width, height, depth) = match *size.each(CaseReader::count)?.as_slice() {
        [width, height, depth] => (width, height, depth),
        _ => return Err(size.unreadable("three counts")),
    };
    let info = GridInfo::new(1.0, width, height, Pose2::IDENTITY)
        .map_err(|error| size.unreadable(&error.to_string()))?;
    let mut grid = VoxelGrid::new(info, u32::try_from(depth).unwrap_or(u32::MAX));
    for (start, end) in lines(&given, &["mark_lines"])? {
        grid.mark_line(start, end);
    }
    let mut column = (0, 0);
    for (at, voxel) in
        given.find("mark_voxels").map_or(Ok(Vec::new()), |it| it.list())?.iter().enumerate()
    {
        let (cell, z) = voxel_of(voxel)?;
        if at == 0 {
            column = cell;
        }
        grid.mark(cell, z, 0);
    }
    let marked = grid.clone();
    let length = |name: &str, usual: u32| -> Result<u32, Unreadable> {
        let count = given.find(name).map(|it| it.count()).transpose()?;
        Ok(count.map_or(usual, |count| u32::try_from(count).unwrap_or(u32::MAX)))
    };
    let (shortest, longest) = (length("min_length", 0)?, length("max_length", u32::MAX)?);
    for (start, end) in lines(&given, &["then_clear_lines", "clear_lines"])? {
        grid.clear_along(start, end, shortest, longest, |_, _| {});
    }
    for name in ["then_clear_voxels", "clear_voxels"] {
        let voxels = given.find(name).map_or(Ok(Vec::new()), |it| it.list())?;
        for voxel in voxels {
            let (cell, z) = voxel_of(&voxel)?;
            grid.clear(cell, z);
        }
    }
    if let Some(index) = given.find("clear_column_index") {
        grid.clear_column(index.count()?);
    }
    if given.find("reset").map_or(Ok(false), |it| it.truth())? {
        grid.reset();
    }
    let columns = columns_of(&grid, &given)?;
    for (name, expected) in expect.members()? {
        let words: Vec<&str> = name.split('_').collect();
        let is_early = words.contains(&"before") || words.contains(&"mark");
        let seen = if is_early { &marked } else { &grid };
        if !words.iter().all(|word| WORDS.contains(word)) {
            differences.not_known(format!("`{}` (words: {})", expected.path(), WORDS.join(", ")));
            continue;
        }
        if name == "size_z" {
            differences.compare(name, &json!(grid.height()), &expected);
        } else if name == "status" {
            match &columns {
                Some(columns) => differences.compare(name, &json!(columns), &expected),
                None => return Err(given.unreadable("one that has `columns`")),
            }
        } else if name == "rays" {
            compare_rays(&info, &expected, differences)?;
        } else if name.starts_with("raw_columns") {
            differences.compare(name, &json!(seen.columns()), &expected);
        } else if name.starts_with("raw_column") {
            let got = seen.columns().get(seen.info().index(column)).copied();
            differences.compare(name, &json!(got), &expected);
        } else if name.starts_with("status_") {
            for (voxel, status) in expected.members()? {
                let place: Vec<usize> =
                    voxel.split(',').filter_map(|it| it.trim().parse().ok()).collect();
                let [x, y, z] = place[..] else {
                    return Err(expected.unreadable("statuses of voxels `x,y,z`"));
                };
                let got = json!(name_of(seen.voxel((x, y), z as u32)));
                differences.compare(format_args!("{name} of {voxel}"), &got, &status);
            }
        } else if let Some(kind) = words.iter().find_map(|word| kind_named(word)) {
            differences.compare(name, &json!(count(seen, kind)), &expected);
        } else if words.contains(&"counts") {
            let all = [Voxel::Marked, Voxel::Unknown, Voxel::Free];
            let mut counts = serde_json::Map::new();
            for kind in all {
                let number = json!(count(seen, kind));
                counts.insert(name_of(kind).to_owned(), number.clone());
                counts.insert(name_of(kind).to_ascii_lowercase(), number);
            }
            differences.compare(name, &Value::Object(counts), &expected);
        } else {
            differences.not_known(format!("`{}`", expected.path()));
        }
    }
    Ok(())
}

/// Words of which the names of expectations are made, such as `status_before`.
const WORDS: [&str; 26] = [
    "raw", "column", "columns", "status", "size", "z", "rays", "count", "counts", "marked",
    "unknown", "free", "before", "after", "mark", "clear", "reset", "of", "voxels", "voxel",
    "number", "total", "all", "cleared", "lines", "line",
];

fn kind_named(word: &str) -> Option<Voxel> {
    match word {
        "marked" => Some(Voxel::Marked),
        "unknown" => Some(Voxel::Unknown),
        "free" => Some(Voxel::Free),
        _ => None,
    }
}

fn count(grid: &VoxelGrid, kind: Voxel) -> usize {
    let GridInfo { width, height, .. } = *grid.info();
    let cells = (0..height).flat_map(|y| (0..width).map(move |x| (x, y)));
    let voxels = cells.flat_map(|cell| (0..grid.height()).map(move |z| (cell, z)));
    voxels.filter(|(cell, z)| grid.voxel(*cell, *z) == kind).count()
}

fn name_of(voxel: Voxel) -> &'static str {
    match voxel {
        Voxel::Free => "FREE",
        Voxel::Unknown => "UNKNOWN",
        Voxel::Marked => "MARKED",
    }
}

/// Statuses of the columns that are asked for, by thresholds that are 0 unless given.
fn columns_of(
    grid: &VoxelGrid,
    given: &CaseReader<'_>,
) -> Result<Option<Vec<&'static str>>, Unreadable> {
    let threshold = |name: &str| -> Result<u32, Unreadable> {
        let count = given.find(name).map_or(Ok(0), |it| it.count())?;
        Ok(u32::try_from(count).unwrap_or(u32::MAX))
    };
    let unknown = threshold("unknown_threshold")?;
    let marked = threshold("marked_threshold")?.max(threshold("mark_threshold")?);
    let Some(columns) = given.find("columns") else { return Ok(None) };
    let columns = columns.each(CaseReader::cell)?.into_iter();
    Ok(Some(columns.map(|cell| name_of(grid.column(cell, unknown, marked))).collect()))
}

fn compare_rays(
    info: &GridInfo,
    expected: &Expected<'_>,
    differences: &mut Differences,
) -> Result<(), Unreadable> {
    for ray in expected.distinct()? {
        let input = ray.input();
        let length = |name: &str, usual: u32| -> Result<u32, Unreadable> {
            let count = input.find(name).map(|it| it.count()).transpose()?;
            Ok(count.map_or(usual, |count| u32::try_from(count).unwrap_or(u32::MAX)))
        };
        let (start, end) = (input.get("start")?.array()?, input.get("end")?.array()?);
        let (shortest, longest) = (length("min_length", 0)?, length("max_length", u32::MAX)?);
        let mut voxels = Vec::new();
        if let Some(line) = VoxelLine::within(info.width, start, end, shortest, longest) {
            line.walk(|index, z| {
                let (x, y) = info.cell(index);
                voxels.push(json!([x, y, z]));
            });
        }
        let what = format!("voxels from {start:?} to {end:?}");
        differences.compare(what, &Value::Array(voxels), &ray.get("voxels")?);
    }
    Ok(())
}

/// Start and end of a line.
type Ends = ([f64; 3], [f64; 3]);

/// Lines from voxel to voxel, under any of some names.
fn lines(given: &CaseReader<'_>, names: &[&str]) -> Result<Vec<Ends>, Unreadable> {
    let mut lines = Vec::new();
    for name in names {
        for line in given.find(name).map_or(Ok(Vec::new()), |it| it.list())? {
            match line.each(CaseReader::array::<3>)?.as_slice() {
                [start, end] => lines.push((*start, *end)),
                _ => return Err(line.unreadable("two voxels")),
            }
        }
    }
    Ok(lines)
}

fn voxel_of(voxel: &CaseReader<'_>) -> Result<((usize, usize), u32), Unreadable> {
    match *voxel.each(CaseReader::count)?.as_slice() {
        [x, y, z] => Ok(((x, y), u32::try_from(z).unwrap_or(MAX_VOXEL_COUNT))),
        _ => Err(voxel.unreadable("three counts")),
    }
}
