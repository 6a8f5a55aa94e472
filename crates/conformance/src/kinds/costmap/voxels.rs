//! Voxels.

use periplus_base::Pose2;
use periplus_costmap::{Line3, MOST_VOXELS, Voxel, VoxelGrid};
use periplus_grid::Lattice;

use super::super::Setting;
use crate::{Case, Differences, Reader, Unreadable};

/// Kind `voxel_grid`: marks, then clears, then what is left.
pub(in super::super) fn check(
    case: &Case,
    _distro: &str,
    _setting: &Setting<'_>,
    differences: &mut Differences,
) -> Result<(), Unreadable> {
    let (given, expect) = (case.given(), case.expect());
    let size = given.get("size")?;
    let (width, height, depth) = match *size.each(Reader::count)?.as_slice() {
        [width, height, depth] => (width, height, depth),
        _ => return Err(size.unreadable("three counts")),
    };
    let lattice = Lattice::new(1.0, width, height, Pose2::IDENTITY)
        .map_err(|error| size.unreadable(&error.to_string()))?;
    let mut grid = VoxelGrid::new(lattice, u32::try_from(depth).unwrap_or(u32::MAX));
    if let Some(size_z) = expect.find("size_z") {
        differences.whole("voxels in a column", grid.height().into(), size_z.integer()?);
    }
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
    compare(&grid, column, &expect, When::Marked, differences)?;
    for (start, end) in lines(&given, &["then_clear_lines", "clear_lines"])? {
        grid.clear_line(start, end);
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
    compare(&grid, column, &expect, When::Cleared, differences)?;
    compare_columns(&grid, &given, &expect, differences)?;
    compare_rays(&lattice, &expect, differences)
}

/// After which of the two.
#[derive(Clone, Copy, PartialEq, Eq)]
enum When {
    Marked,
    Cleared,
}

/// What is expected at some time, by names such as `raw_column_after_mark`, `status_before` and
/// `marked_count_after_clear`.
fn compare(
    grid: &VoxelGrid,
    column: (usize, usize),
    expect: &Reader<'_>,
    when: When,
    differences: &mut Differences,
) -> Result<(), Unreadable> {
    for (name, expected) in expect.members()? {
        let words: Vec<&str> = name.split('_').collect();
        let is_early = words.contains(&"before") || words.contains(&"mark");
        if is_early != (when == When::Marked) {
            continue;
        }
        if name.starts_with("raw_column") {
            let got = grid.columns().get(grid.lattice().index(column)).copied();
            differences.same(name, &got.map(i64::from), &Some(expected.integer()?));
        } else if name.starts_with("status_") {
            for (voxel, status) in expected.members()? {
                let place: Vec<usize> =
                    voxel.split(',').filter_map(|it| it.trim().parse().ok()).collect();
                let [x, y, z] = place[..] else { return Err(expected.unreadable("voxels")) };
                let got = grid.voxel((x, y), z as u32);
                differences.same(format_args!("{name} of {voxel}"), name_of(got), status.text()?);
            }
        } else if let Some(kind) = words.iter().find_map(|word| kind_named(word)) {
            differences.same(name, &count(grid, kind), &expected.count()?);
        } else if words.contains(&"counts") {
            for (kind, expected) in expected.members()? {
                let kind = kind_named(&kind.to_ascii_lowercase())
                    .ok_or_else(|| expected.unreadable("a count of a status"))?;
                differences.same(name, &count(grid, kind), &expected.count()?);
            }
        }
    }
    Ok(())
}

fn kind_named(word: &str) -> Option<Voxel> {
    match word {
        "marked" => Some(Voxel::Marked),
        "unknown" => Some(Voxel::Unknown),
        "free" => Some(Voxel::Free),
        _ => None,
    }
}

fn count(grid: &VoxelGrid, kind: Voxel) -> usize {
    let Lattice { width, height, .. } = *grid.lattice();
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

/// Columns, by thresholds that are 0 unless given.
fn compare_columns(
    grid: &VoxelGrid,
    given: &Reader<'_>,
    expect: &Reader<'_>,
    differences: &mut Differences,
) -> Result<(), Unreadable> {
    let (Some(columns), Some(expected)) = (given.find("columns"), expect.find("status")) else {
        return Ok(());
    };
    let threshold = |name: &str| -> Result<u32, Unreadable> {
        let count = given.find(name).map_or(Ok(0), |it| it.count())?;
        Ok(u32::try_from(count).unwrap_or(u32::MAX))
    };
    let unknown = threshold("unknown_threshold")?;
    let marked = threshold("marked_threshold")?.max(threshold("mark_threshold")?);
    for (cell, expected) in columns.each(Reader::cell)?.into_iter().zip(expected.list()?) {
        let got = grid.column(cell, unknown, marked);
        differences.same(format_args!("column {cell:?}"), name_of(got), expected.text()?);
    }
    Ok(())
}

fn compare_rays(
    lattice: &Lattice,
    expect: &Reader<'_>,
    differences: &mut Differences,
) -> Result<(), Unreadable> {
    for ray in expect.find("rays").map_or(Ok(Vec::new()), |it| it.list())? {
        let length = |name: &str, usual: u32| -> Result<u32, Unreadable> {
            let count = ray.find(name).map(|it| it.count()).transpose()?;
            Ok(count.map_or(usual, |count| u32::try_from(count).unwrap_or(u32::MAX)))
        };
        let (start, end) = (ray.get("start")?.array()?, ray.get("end")?.array()?);
        let (shortest, longest) = (length("min_length", 0)?, length("max_length", u32::MAX)?);
        let mut voxels = Vec::new();
        if let Some(line) = Line3::within(lattice.width, start, end, shortest, longest) {
            line.walk(|index, z| {
                let (x, y) = lattice.cell(index);
                voxels.push(vec![x, y, z as usize]);
            });
        }
        let expected = ray.get("voxels")?.each(|voxel| voxel.each(Reader::count))?;
        differences.same(format_args!("voxels from {start:?} to {end:?}"), &voxels, &expected);
    }
    Ok(())
}

/// Where a line begins and ends.
type Ends = ([f64; 3], [f64; 3]);

/// Lines from voxel to voxel, under any of some names.
fn lines(given: &Reader<'_>, names: &[&str]) -> Result<Vec<Ends>, Unreadable> {
    let mut lines = Vec::new();
    for name in names {
        for line in given.find(name).map_or(Ok(Vec::new()), |it| it.list())? {
            match line.each(Reader::array::<3>)?.as_slice() {
                [start, end] => lines.push((*start, *end)),
                _ => return Err(line.unreadable("two voxels")),
            }
        }
    }
    Ok(lines)
}

fn voxel_of(voxel: &Reader<'_>) -> Result<((usize, usize), u32), Unreadable> {
    match *voxel.each(Reader::count)?.as_slice() {
        [x, y, z] => Ok(((x, y), u32::try_from(z).unwrap_or(MOST_VOXELS))),
        _ => Err(voxel.unreadable("three counts")),
    }
}
