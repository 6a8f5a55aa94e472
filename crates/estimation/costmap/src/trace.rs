//! Last reading that changed each cell.

use std::sync::Arc;

use periplus_grid::{Cell, Grid, GridInfo};

use crate::Observation;

/// Largest grid that is traced by default: a trace uses 12 bytes per cell.
const MAX_TRACED_CELLS: usize = 1 << 20;

/// Number of readings at which unreferenced ones are removed for the first time.
const INITIAL_READINGS: usize = 1 << 12;

/// Maximum number of referenced readings; beyond it the oldest half is dropped, and cells last
/// changed by those have no cause.
const MAX_READINGS: usize = 1 << 16;

/// Reading that changed a cell.
#[derive(Clone, Debug, PartialEq)]
pub struct Cause {
    /// Source.
    pub source: String,
    /// True if the cell was marked, false if a ray cleared it.
    pub is_mark: bool,
    /// Time of the reading \[ns\].
    pub time_ns: i64,
    /// Origin of the ray in the global frame \[m\].
    pub origin: [f32; 3],
    /// End of the ray in the global frame \[m\].
    pub end: [f32; 2],
}

#[derive(Clone, Debug)]
struct Reading {
    source: Arc<str>,
    time_ns: i64,
    origin: [f32; 3],
}

#[derive(Clone, Copy, Debug, Default, PartialEq)]
struct Touch {
    /// Twice the index of the reading, counted from 1, plus one for a mark; 0 for none.
    reading: u32,
    end: [f32; 2],
}

impl Touch {
    /// Index of the reading, counted from 1; 0 for none.
    fn place(self) -> usize {
        (self.reading / 2) as usize
    }
}

/// Record of the reading that last changed each cell.
#[derive(Clone, Debug, Default)]
pub(crate) struct ReadingTrace {
    touches: Option<Grid<Touch>>,
    /// Oldest first.
    readings: Vec<Reading>,
    /// Number of readings at which unreferenced ones are removed.
    limit: usize,
}

impl ReadingTrace {
    pub(crate) fn resize(&mut self, info: &GridInfo) {
        *self = Self::default();
        if info.len() <= MAX_TRACED_CELLS {
            self.touches = Some(Grid::new(*info, Touch::default()));
        }
    }

    /// Moves with the cells of a layer.
    pub(crate) fn follow(&mut self, there: &GridInfo) {
        if let Some(touches) = &mut self.touches {
            let here = &touches.info;
            let cells = |to: f64, from: f64| libm::round((to - from) / here.resolution_m) as i64;
            let columns = cells(there.origin.x_m, here.origin.x_m);
            let rows = cells(there.origin.y_m, here.origin.y_m);
            touches.roll(columns, rows, Touch::default());
            touches.info.origin = there.origin;
        }
    }

    pub(crate) fn forget(&mut self) {
        if let Some(touches) = &mut self.touches {
            touches.cells.fill(Touch::default());
        }
        self.readings.clear();
    }

    /// Returns a writer for the cells that a reading changes; none when tracing is off.
    pub(crate) fn writer(
        &mut self,
        source: &str,
        seen: &Observation,
        is_mark: bool,
    ) -> Option<TraceWriter<'_>> {
        self.touches.as_ref()?;
        let origin = seen.origin.map(|at| at as f32);
        let is_same = self.readings.last().is_some_and(|last| {
            last.time_ns == seen.time_ns && *last.source == *source && last.origin == origin
        });
        if !is_same {
            self.make_room();
            let known = self.readings.iter().rev().find(|known| *known.source == *source);
            let source = known.map_or_else(|| source.into(), |known| Arc::clone(&known.source));
            self.readings.push(Reading { source, time_ns: seen.time_ns, origin });
        }
        let touches = self.touches.as_mut()?;
        let number = self.readings.len() as u32;
        Some(TraceWriter { touches: &mut touches.cells, reading: 2 * number + u32::from(is_mark) })
    }

    /// Removes unreferenced readings once there are many: memory stays bounded during long runs,
    /// while marks of any age can be explained.
    fn make_room(&mut self) {
        if self.readings.len() < self.limit.max(INITIAL_READINGS) {
            return;
        }
        let Some(touches) = &mut self.touches else { return };
        let mut is_needed = vec![false; self.readings.len() + 1];
        for touch in &touches.cells {
            is_needed[touch.place()] = true;
        }
        is_needed[0] = false;
        let needed = is_needed.iter().filter(|is_needed| **is_needed).count();
        let mut surplus = if needed > MAX_READINGS { needed - MAX_READINGS / 2 } else { 0 };
        // New index of each reading; 0 for removed ones.
        let mut places = vec![0_u32; is_needed.len()];
        let mut kept = Vec::with_capacity(needed);
        for (place, is_needed) in is_needed.into_iter().enumerate() {
            if !is_needed {
                continue;
            }
            if surplus > 0 {
                surplus -= 1;
                continue;
            }
            kept.push(self.readings[place - 1].clone());
            places[place] = kept.len() as u32;
        }
        for touch in &mut touches.cells {
            let place = places[touch.place()];
            touch.reading = if place == 0 { 0 } else { 2 * place + touch.reading % 2 };
        }
        // Removes again only after many more readings.
        self.limit = (2 * kept.len()).max(INITIAL_READINGS);
        self.readings = kept;
    }

    pub(crate) fn cause(&self, cell: Cell) -> Option<Cause> {
        let touch = self.touches.as_ref()?.get(cell)?;
        let reading = self.readings.get(touch.place().checked_sub(1)?)?;
        Some(Cause {
            source: reading.source.to_string(),
            is_mark: touch.reading % 2 == 1,
            time_ns: reading.time_ns,
            origin: reading.origin,
            end: touch.end,
        })
    }
}

/// Writer for the cells that one reading changes.
pub(crate) struct TraceWriter<'a> {
    touches: &'a mut [Touch],
    reading: u32,
}

impl TraceWriter<'_> {
    #[inline]
    pub(crate) fn note(&mut self, index: usize, end: [f32; 2]) {
        if let Some(touch) = self.touches.get_mut(index) {
            *touch = Touch { reading: self.reading, end };
        }
    }
}

#[cfg(test)]
mod tests {
    use periplus_geometry::Pose2;

    use super::*;

    #[test]
    fn old_marks_are_explained_and_nobody_remembers_what_is_not_needed() {
        let mut trace = ReadingTrace::default();
        trace.resize(&GridInfo::new(1.0, 10, 1, Pose2::IDENTITY).unwrap());
        let seen = |time_ns| Observation { time_ns, ..Observation::default() };
        let mut most = 0;
        for time_ns in 0..100_000 {
            // The first reading marks cell 0, all others clear cells 1 to 9 in turn.
            let is_first = time_ns == 0;
            let mut writer = trace.writer("scan", &seen(time_ns), is_first).unwrap();
            writer.note(if is_first { 0 } else { 1 + time_ns as usize % 9 }, [0.5, 0.5]);
            most = most.max(trace.readings.len());
        }
        assert_eq!(most, INITIAL_READINGS);
        let cause = trace.cause((0, 0)).unwrap();
        assert_eq!((cause.is_mark, cause.time_ns, cause.source.as_str()), (true, 0, "scan"));
        let cause = trace.cause((1, 0)).unwrap();
        assert_eq!((cause.is_mark, cause.time_ns), (false, 99_999));
    }
}
