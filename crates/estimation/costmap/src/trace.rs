//! Which reading changed a cell last.

use std::sync::Arc;

use periplus_grid::{Cell, Grid, GridInfo};

use crate::Observation;

/// Larger grids are not traced unless somebody asks for it: it takes 12 bytes for each cell.
const MOST_TRACED_CELLS: usize = 1 << 20;

/// When so many readings are remembered, those are forgotten that no cell speaks of any more.
const READINGS_AT_FIRST: usize = 1 << 12;

/// If cells speak of more readings than this, the oldest half is forgotten; cells last touched by those
/// cannot tell by what.
const MOST_READINGS: usize = 1 << 16;

/// What changed a cell.
#[derive(Clone, Debug, PartialEq)]
pub struct Cause {
    /// The source.
    pub source: String,
    /// Whether it was marked; otherwise a ray went through it.
    pub is_mark: bool,
    /// When it was seen \[ns\].
    pub time_ns: i64,
    /// Where the ray began, in the global frame \[m\].
    pub origin: [f32; 3],
    /// Where it ended, in the global frame \[m\].
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
    /// Twice the place of the reading in the list, counted from 1, plus one for a mark; 0 for none.
    reading: u32,
    end: [f32; 2],
}

impl Touch {
    /// The place of its reading, counted from 1; 0 for none.
    fn place(self) -> usize {
        (self.reading / 2) as usize
    }
}

/// Remembers which reading changed each cell last.
#[derive(Clone, Debug, Default)]
pub(crate) struct Trace {
    touches: Option<Grid<Touch>>,
    /// Oldest first.
    readings: Vec<Reading>,
    /// So many may be there before it is looked which of them are needed.
    limit: usize,
}

impl Trace {
    pub(crate) fn resize(&mut self, info: &GridInfo) {
        *self = Self::default();
        if info.len() <= MOST_TRACED_CELLS {
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

    /// A pen that notes what a reading touches; none when nothing is traced.
    pub(crate) fn pen(
        &mut self,
        source: &str,
        seen: &Observation,
        is_mark: bool,
    ) -> Option<Pen<'_>> {
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
        Some(Pen { touches: &mut touches.cells, reading: 2 * number + u32::from(is_mark) })
    }

    /// Forgets readings that no cell speaks of, once there are many: memory stays as it is however
    /// long a robot drives, and a mark can be explained however old it is.
    fn make_room(&mut self) {
        if self.readings.len() < self.limit.max(READINGS_AT_FIRST) {
            return;
        }
        let Some(touches) = &mut self.touches else { return };
        let mut is_needed = vec![false; self.readings.len() + 1];
        for touch in &touches.cells {
            is_needed[touch.place()] = true;
        }
        is_needed[0] = false;
        let needed = is_needed.iter().filter(|is_needed| **is_needed).count();
        let mut surplus = if needed > MOST_READINGS { needed - MOST_READINGS / 2 } else { 0 };
        // Where each goes; 0 for those that are forgotten.
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
        // So that this is done after many more readings, not after each.
        self.limit = (2 * kept.len()).max(READINGS_AT_FIRST);
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

/// Notes what one reading touches.
pub(crate) struct Pen<'a> {
    touches: &'a mut [Touch],
    reading: u32,
}

impl Pen<'_> {
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
        let mut trace = Trace::default();
        trace.resize(&GridInfo::new(1.0, 10, 1, Pose2::IDENTITY).unwrap());
        let seen = |time_ns| Observation { time_ns, ..Observation::default() };
        let mut most = 0;
        for time_ns in 0..100_000 {
            // The first reading marks cell 0, all others clear cells 1 to 9 in turn.
            let is_first = time_ns == 0;
            let mut pen = trace.pen("scan", &seen(time_ns), is_first).unwrap();
            pen.note(if is_first { 0 } else { 1 + time_ns as usize % 9 }, [0.5, 0.5]);
            most = most.max(trace.readings.len());
        }
        assert_eq!(most, READINGS_AT_FIRST);
        let cause = trace.cause((0, 0)).unwrap();
        assert_eq!((cause.is_mark, cause.time_ns, cause.source.as_str()), (true, 0, "scan"));
        let cause = trace.cause((1, 0)).unwrap();
        assert_eq!((cause.is_mark, cause.time_ns), (false, 99_999));
    }
}
