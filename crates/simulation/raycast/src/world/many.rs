//! Many rays at a time.

use std::marker::PhantomData;
use std::vec::Drain;

use super::company::Company;
use super::query::{Found, Scratch, hit_of, single_above};
use super::shares::in_shares;
use super::{Filter, World};
use crate::local::LocalRay;
use crate::mesh::{Nearest, Queue};
use crate::ray::{Hit, Ray};
use crate::simd::{Task, V8, dispatch};

/// Trees of so many triangles are larger than the nearest caches, and a wide pyramid meets far more
/// of them than its rays do.
const MANY_TRIANGLES: usize = 50_000;
/// Fewer rays than this do not go in turns.
const FEW: usize = 8;
/// So many rays wait until they go in turns: few enough that they stay in the cache.
const LOOSE_MAX: usize = 2048;

/// How far apart in slope rays may lie.
#[derive(Clone, Copy)]
struct Widest {
    /// Eight of them; those farther apart have little in common, and go one by one.
    packet: f32,
    /// All that go together.
    company: f32,
}

const WIDEST: Widest = Widest { packet: 0.5, company: 0.2 };
const WIDEST_AMONG_MANY: Widest = Widest { packet: 0.1, company: 0.03 };

/// How rays are gathered by eights: so many columns, so many rows.
#[derive(Clone, Copy)]
struct Tile {
    columns: usize,
    rows: usize,
}

/// Rows of an image that may go together.
pub(super) const BAND: usize = 4;

const LINE: Tile = Tile { columns: 8, rows: 1 };
const PATCH: Tile = Tile { columns: 4, rows: 2 };

impl World {
    /// Distances of many rays, infinite where nothing is: the same that [`Self::cast`] finds for
    /// each, with any number of `threads`. Neighbours of one origin are traced together, so keep
    /// scans and images in order. Few rays stay on this thread.
    ///
    /// # Panics
    /// When there are not as many places as rays.
    pub fn cast_many(&self, rays: &[Ray], filter: Filter, threads: usize, distances_m: &mut [f32]) {
        self.cast_grid(rays, rays.len(), filter, threads, distances_m);
    }

    /// [`Self::cast_many`] for rays that lie in rows of `columns`, like the pixels of an image or
    /// the beams of a lidar, where the one below is a neighbour as well.
    ///
    /// # Panics
    /// When there are not as many places as rays.
    pub fn cast_grid(
        &self,
        rays: &[Ray],
        columns: usize,
        filter: Filter,
        threads: usize,
        distances_m: &mut [f32],
    ) {
        in_shares(rays, columns, threads, distances_m, |rays, columns, distances_m| {
            #[expect(clippy::cast_possible_truncation, reason = "single precision is asked for")]
            dispatch(Many {
                world: self,
                rays,
                columns,
                filter,
                give: |index: usize, found: &Found| {
                    distances_m[index] =
                        if found.is_hit() { found.distance as f32 } else { f32::INFINITY };
                },
            });
        });
    }

    /// What [`Self::cast`] finds for each of many rays in rows of `columns`.
    ///
    /// # Panics
    /// When there are not as many places as rays.
    pub fn hits_grid(
        &self,
        rays: &[Ray],
        columns: usize,
        filter: Filter,
        threads: usize,
        hits: &mut [Option<Hit>],
    ) {
        in_shares(rays, columns, threads, hits, |rays, columns, hits| {
            // Neighbours mostly meet the same face.
            let mut last = (Found::nothing(0.0), None);
            dispatch(Many {
                world: self,
                rays,
                columns,
                filter,
                give: |index: usize, found: &Found| {
                    let ray = &rays[index];
                    hits[index] = found.is_hit().then(|| {
                        if !last.0.is_same_face(found) {
                            last = (*found, self.flat_normal(found));
                        }
                        let normal = last.1.unwrap_or_else(|| self.round_normal(ray, found));
                        hit_of(ray, found, normal)
                    });
                },
            });
        });
    }
}

struct Many<'a, F> {
    world: &'a World,
    rays: &'a [Ray],
    columns: usize,
    filter: Filter,
    give: F,
}

/// Rays that take turns through the fixed triangles, one after the other through the rest.
struct Loose<'a, 'b, V, F> {
    many: &'a mut Many<'b, F>,
    places: Drain<'a, usize>,
    scratch: &'a mut Scratch,
    vectors: PhantomData<V>,
}

impl<V: V8, F: FnMut(usize, &Found)> Queue for Loose<'_, '_, V, F> {
    type Ticket = (usize, Found);

    #[inline(always)]
    fn next(&mut self) -> Option<(Self::Ticket, LocalRay, f32)> {
        let world = self.many.world;
        for place in self.places.by_ref() {
            let ray = &self.many.rays[place];
            let mut found = Found::nothing(ray.max_m);
            if !ray.is_sound() {
                (self.many.give)(place, &found);
                continue;
            }
            world.find_endless(ray, self.many.filter, &mut found);
            let local = world.fixed.localize(ray.origin_m, ray.direction, ray.min_m);
            return Some(((place, found), local, single_above(found.distance)));
        }
        None
    }

    #[inline(always)]
    fn done(&mut self, (place, mut found): Self::Ticket, nearest: Nearest) {
        let (world, rays, filter) = (self.many.world, self.many.rays, self.many.filter);
        world.take_fixed(nearest, &mut found);
        world.find_instances::<V, false>(&rays[place], filter, &mut found, self.scratch);
        (self.many.give)(place, &found);
    }
}

impl<F: FnMut(usize, &Found)> Task for Many<'_, F> {
    type Output = ();

    #[inline(always)]
    fn run<V: V8>(mut self) {
        let mut scratch = Scratch::new();
        let mut company = Company::new();
        let mut loose = Vec::new();
        let many = self.world.fixed.len() > MANY_TRIANGLES;
        let widest = if many { WIDEST_AMONG_MANY } else { WIDEST };
        let together = self.world.sees_all_fixed(self.filter);
        let columns = self.columns;
        let rows = self.rays.len().div_ceil(columns);
        let (tile, band) = if rows > 1 { (PATCH, BAND) } else { (LINE, 1) };
        let corners = (0..rows).step_by(band).flat_map(|first| {
            (0..columns).step_by(tile.columns).flat_map(move |left| {
                (first..(first + band).min(rows)).step_by(tile.rows).map(move |top| (top, left))
            })
        });
        for (top, left) in corners {
            let mut picked = [0_usize; 8];
            let mut count = 0;
            for row in top..(top + tile.rows).min(rows) {
                for column in left..(left + tile.columns).min(columns) {
                    let index = row * columns + column;
                    if index < self.rays.len() {
                        picked[count] = index;
                        count += 1;
                    }
                }
            }
            let picked = &picked[..count];
            if together && self.join::<V>(picked, widest, &mut company, &mut scratch) {
                continue;
            }
            if together && many {
                loose.extend_from_slice(picked);
            } else {
                for &index in picked {
                    self.single::<V>(index, &mut scratch);
                }
            }
            if loose.len() >= LOOSE_MAX {
                self.in_turns::<V>(&mut loose, &mut scratch);
            }
        }
        self.send::<V>(&mut company, &mut scratch);
        self.in_turns::<V>(&mut loose, &mut scratch);
    }
}

impl<F: FnMut(usize, &Found)> Many<'_, F> {
    /// Takes neighbours into the company, after sending that off if they do not fit. False when
    /// they do not go together; then nothing was done.
    #[inline(always)]
    fn join<V: V8>(
        &mut self,
        picked: &[usize],
        widest: Widest,
        company: &mut Company,
        scratch: &mut Scratch,
    ) -> bool {
        if picked.len() < 2 {
            return false;
        }
        let Some((packet, member)) = self.world.packet_of::<V>(self.rays, picked) else {
            return false;
        };
        if packet.pyramid.spread() > widest.packet {
            return false;
        }
        if !company.admits(&packet, widest.company) {
            self.send::<V>(company, scratch);
        }
        company.push(packet, member);
        true
    }

    #[inline(always)]
    fn send<V: V8>(&mut self, company: &mut Company, scratch: &mut Scratch) {
        let (world, rays, filter) = (self.world, self.rays, self.filter);
        company.trace::<V>(world, rays, filter, scratch, &mut self.give);
    }

    /// Traces rays that have little in common, and forgets them.
    #[inline(always)]
    fn in_turns<V: V8>(&mut self, loose: &mut Vec<usize>, scratch: &mut Scratch) {
        if loose.len() < FEW {
            for index in loose.drain(..) {
                self.single::<V>(index, scratch);
            }
            return;
        }
        let world = self.world;
        let (places, vectors) = (loose.drain(..), PhantomData);
        world.fixed.trace_in_turns::<V, _>(&mut Loose::<V, _> {
            many: self,
            places,
            scratch,
            vectors,
        });
    }

    #[inline(always)]
    fn single<V: V8>(&mut self, index: usize, scratch: &mut Scratch) {
        let found = self.world.find::<V, false>(&self.rays[index], self.filter, scratch);
        (self.give)(index, &found);
    }
}
