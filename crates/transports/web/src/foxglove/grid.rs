//! Map updates.

use periplus_msgs::map_msgs::OccupancyGridUpdate;
use periplus_msgs::nav_msgs::OccupancyGrid;

/// Difference between two maps.
#[derive(Clone, Debug, PartialEq)]
pub(crate) enum Difference {
    /// Origin, resolution or size changed: send the whole map.
    All,
    /// Cells changed in this rectangle only.
    Part(OccupancyGridUpdate),
    /// No cell changed.
    None,
}

/// Computes the difference between `before` and `now`: the smallest rectangle with all changed
/// cells.
pub(crate) fn difference(before: &OccupancyGrid, now: &OccupancyGrid) -> Difference {
    let width = now.info.width as usize;
    let is_same_place = before.header.frame_id == now.header.frame_id
        && before.info.resolution.to_bits() == now.info.resolution.to_bits()
        && (before.info.width, before.info.height) == (now.info.width, now.info.height)
        && before.info.origin == now.info.origin;
    let is_whole = |grid: &OccupancyGrid| grid.data.len() == width * grid.info.height as usize;
    if !is_same_place || !is_whole(before) || !is_whole(now) || width == 0 {
        return Difference::All;
    }
    let (old, new) = (before.data.chunks_exact(width), now.data.chunks_exact(width));
    let mut rows: Option<(usize, usize)> = None;
    let mut columns = (width, 0);
    for (row, (old, new)) in old.zip(new).enumerate() {
        if old == new {
            continue;
        }
        let differs = |(one, other): (&i8, &i8)| one != other;
        let first = old.iter().zip(new).position(differs).unwrap_or(0);
        let last = old.iter().zip(new).rposition(differs).unwrap_or(width - 1);
        columns = (columns.0.min(first), columns.1.max(last));
        rows = Some((rows.map_or(row, |(top, _)| top), row));
    }
    let Some((top, bottom)) = rows else { return Difference::None };
    let part = |row: usize| &now.data[row * width + columns.0..=row * width + columns.1];
    let number = |place: usize| i32::try_from(place).unwrap_or(i32::MAX);
    Difference::Part(OccupancyGridUpdate {
        header: now.header.clone(),
        x: number(columns.0),
        y: number(top),
        width: (columns.1 - columns.0 + 1) as u32,
        height: (bottom - top + 1) as u32,
        data: (top..=bottom).flat_map(part).copied().collect(),
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    fn map(width: u32, data: &[i8]) -> OccupancyGrid {
        let mut map = OccupancyGrid { data: data.to_vec(), ..OccupancyGrid::default() };
        map.info.width = width;
        map.info.height = data.len() as u32 / width;
        map
    }

    #[test]
    fn only_what_changed_is_told() {
        let before = map(3, &[0, 0, 0, 0, 0, 0, 0, 0, 0]);
        let now = map(3, &[0, 0, 0, 0, 7, 0, 0, 0, 9]);
        let Difference::Part(part) = difference(&before, &now) else { panic!("a part") };
        assert_eq!((part.x, part.y, part.width, part.height), (1, 1, 2, 2));
        assert_eq!(part.data, [7, 0, 0, 9]);
        assert_eq!(difference(&now, &now), Difference::None);
    }

    #[test]
    fn another_place_is_another_map() {
        let before = map(2, &[0; 4]);
        let mut now = before.clone();
        now.info.origin.position.x = 1.0;
        assert_eq!(difference(&before, &now), Difference::All);
        assert_eq!(difference(&before, &map(4, &[0; 4])), Difference::All);
        let mut broken = before.clone();
        broken.data = vec![0; 3];
        assert_eq!(difference(&before, &broken), Difference::All);
    }
}
