//! Which reading changed a cell last.

use std::collections::VecDeque;

use periplus_grid::{Cell, Grid, Lattice};

use crate::Observation;

/// Larger grids are not traced unless somebody asks for it: it takes 12 bytes for each cell.
const MOST_TRACED_CELLS: usize = 1 << 20;

/// Readings that are remembered; of cells touched by older ones only their age is known.
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
    source: String,
    time_ns: i64,
    origin: [f32; 3],
}

#[derive(Clone, Copy, Debug, Default, PartialEq)]
struct Touch {
    /// Twice the number of the reading, plus one for a mark; 0 for none.
    reading: u32,
    end: [f32; 2],
}

/// Remembers which reading changed each cell last.
#[derive(Clone, Debug)]
pub(crate) struct Trace {
    touches: Option<Grid<Touch>>,
    readings: VecDeque<Reading>,
    /// Number of the first of them; numbers begin with 1.
    first: u32,
}

impl Default for Trace {
    fn default() -> Self {
        Self { touches: None, readings: VecDeque::new(), first: 1 }
    }
}

impl Trace {
    pub(crate) fn resize(&mut self, lattice: &Lattice) {
        *self = Self::default();
        if lattice.len() <= MOST_TRACED_CELLS {
            self.touches = Some(Grid::new(*lattice, Touch::default()));
        }
    }

    /// Moves with the cells of a layer.
    pub(crate) fn follow(&mut self, there: &Lattice) {
        if let Some(touches) = &mut self.touches {
            let here = &touches.lattice;
            let cells = |to: f64, from: f64| libm::round((to - from) / here.resolution_m) as i64;
            let columns = cells(there.origin.x_m, here.origin.x_m);
            let rows = cells(there.origin.y_m, here.origin.y_m);
            touches.roll(columns, rows, Touch::default());
            touches.lattice.origin = there.origin;
        }
    }

    pub(crate) fn forget(&mut self) {
        if let Some(touches) = &mut self.touches {
            touches.cells.fill(Touch::default());
        }
        self.readings.clear();
        self.first = 1;
    }

    /// A pen that notes what a reading touches; none when nothing is traced.
    pub(crate) fn pen(
        &mut self,
        source: &str,
        seen: &Observation,
        is_mark: bool,
    ) -> Option<Pen<'_>> {
        let touches = self.touches.as_mut()?;
        let origin = seen.origin.map(|at| at as f32);
        let is_same = self.readings.back().is_some_and(|last| {
            last.time_ns == seen.time_ns && last.source == source && last.origin == origin
        });
        if !is_same {
            if self.readings.len() == MOST_READINGS {
                self.readings.pop_front();
                self.first = self.first.wrapping_add(1) & (u32::MAX >> 1);
            }
            let reading = Reading { source: source.to_owned(), time_ns: seen.time_ns, origin };
            self.readings.push_back(reading);
        }
        let number = (self.first + self.readings.len() as u32 - 1) & (u32::MAX >> 1);
        Some(Pen { touches: &mut touches.cells, reading: 2 * number + u32::from(is_mark) })
    }

    pub(crate) fn cause(&self, cell: Cell) -> Option<Cause> {
        let touch = self.touches.as_ref()?.get(cell)?;
        let number = touch.reading / 2;
        let index = number.checked_sub(self.first)?;
        let reading = self.readings.get(usize::try_from(index).ok()?)?;
        Some(Cause {
            source: reading.source.clone(),
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
