//! Rays of one origin on their way together.

use std::marker::PhantomData;

use periplus_geometry::DVec3;

use super::lanes::Lanes;
use super::query::{Found, Scratch, single_above};
use super::{Body, Filter, World};
use crate::bvh::leaf_range;
use crate::mesh::{Best, TriangleMesh};
use crate::packet::{Frustum, GROUP, Packet, Pyramid};
use crate::ray::Ray;
use crate::simd::{Row, V8};
use crate::walk::{Leaves, Stack, Step, walk};

/// Up to eight packets, and the pyramid around them.
pub(super) struct Company {
    pyramid: Option<Pyramid>,
    packets: Vec<Packet>,
    members: Vec<Member>,
    /// Only where there is more than triangles.
    lanes: Vec<Lanes>,
}

/// The rays of a packet by their places in a list; lanes beyond are copies of the first.
#[derive(Clone, Copy)]
pub(super) struct Member {
    places: [usize; 8],
    count: usize,
}

impl Company {
    pub(super) fn new() -> Self {
        Self {
            pyramid: None,
            packets: Vec::with_capacity(GROUP),
            members: Vec::with_capacity(GROUP),
            lanes: Vec::new(),
        }
    }

    /// Whether there is room for a packet in a pyramid no wider than `widest`.
    #[inline(always)]
    pub(super) fn admits(&self, packet: &Packet, widest: f32) -> bool {
        let Some(own) = &self.pyramid else { return true };
        self.packets.len() < GROUP
            && own.with(&packet.pyramid).is_some_and(|all| all.spread() <= widest)
    }

    #[inline(always)]
    pub(super) fn push(&mut self, packet: Packet, member: Member) {
        let own = self.pyramid.and_then(|own| own.with(&packet.pyramid));
        self.pyramid = Some(own.unwrap_or(packet.pyramid));
        self.packets.push(packet);
        self.members.push(member);
    }

    /// Sends all through the world, and is empty again.
    #[inline(always)]
    pub(super) fn trace<V: V8>(
        &mut self,
        world: &World,
        rays: &[Ray],
        filter: Filter,
        scratch: &mut Scratch,
        give: &mut impl FnMut(usize, &Found),
    ) {
        let Some(pyramid) = self.pyramid.take() else { return };
        let instances = !world.resting.nodes.is_empty() || !world.moving.nodes.is_empty();
        let mut found = [[Found::nothing(0.0); 8]; GROUP];
        let mut best = [Best::within(Row([0.0; 8])); GROUP];
        for ((member, found), best) in self.members.iter().zip(&mut found).zip(&mut best) {
            if instances || !world.endless.is_empty() {
                let lanes = Lanes::new(&member.rays(rays));
                *found = lanes.nothing();
                for &number in &world.endless {
                    let Lanes { origins_m, directions, min, .. } = &lanes;
                    world.find_solid_eight::<V>(number, origins_m, directions, min, filter, found);
                }
                self.lanes.push(lanes);
            } else {
                for (found, &place) in found.iter_mut().zip(&member.places) {
                    found.distance = rays[place].max_m;
                }
            }
            *best = start(found);
        }
        if !world.fixed.is_empty() {
            let best = &mut best[..self.packets.len()];
            world.fixed.trace_packets::<V>(&pyramid, &self.packets, best, &mut scratch.body);
            for (found, best) in found.iter_mut().zip(best) {
                for (lane, found) in found.iter_mut().enumerate() {
                    if let Some((distance, id)) = best.get(lane) {
                        let (instance, primitive) = world.part_of(id);
                        found.consider(distance.into(), instance, primitive);
                    }
                }
            }
        }
        if instances {
            let members = self.members.iter().zip(&self.packets).zip(&self.lanes);
            for (((member, packet), lanes), found) in members.zip(&mut found) {
                let all = member.rays(rays);
                let rays = &all[..member.count];
                world.find_instances_packet::<V>(rays, lanes, packet, filter, found, scratch);
            }
        }
        for (member, found) in self.members.iter().zip(&found) {
            for (&place, found) in member.places[..member.count].iter().zip(found) {
                give(place, found);
            }
        }
        self.packets.clear();
        self.members.clear();
        self.lanes.clear();
    }
}

impl Member {
    #[inline(always)]
    fn rays<'a>(&self, rays: &'a [Ray]) -> [&'a Ray; 8] {
        let mut own = [&rays[self.places[0]]; 8];
        for (own, &place) in own.iter_mut().zip(&self.places) {
            *own = &rays[place];
        }
        own
    }
}

impl World {
    /// Up to eight rays as a packet in the frame of the fixed triangles, if they are sound, of one
    /// origin, and go together.
    #[inline(always)]
    pub(super) fn packet_of<V: V8>(
        &self,
        rays: &[Ray],
        picked: &[usize],
    ) -> Option<(Packet, Member)> {
        let first = *picked.first()?;
        let mut member = Member { places: [first; 8], count: picked.len() };
        let origin_m = rays[first].origin_m;
        let (mut directions, mut min) = ([rays[first].direction; 8], [0.0; 8]);
        let mut fits = true;
        for (lane, &place) in picked.iter().enumerate() {
            let ray = &rays[place];
            member.places[lane] = place;
            fits &= ray.origin_m == origin_m && ray.is_sound();
            directions[lane] = ray.direction;
            min[lane] = single(ray.min_m);
        }
        for lane in picked.len()..8 {
            min[lane] = min[0];
        }
        if !fits {
            return None;
        }
        let packet = Packet::new::<V>(origin_m - self.fixed.middle_m, &directions, Row(min))?;
        Some((packet, member))
    }

    /// `packet` is in the frame of the fixed triangles, which is that of the trees over instances.
    #[inline(always)]
    fn find_instances_packet<V: V8>(
        &self,
        rays: &[&Ray],
        lanes: &Lanes,
        packet: &Packet,
        filter: Filter,
        found: &mut [Found; 8],
        scratch: &mut Scratch,
    ) {
        let frustum = Frustum::<V>::new(&packet.pyramid, 0.0);
        let Scratch { top, body } = scratch;
        for tree in [&self.resting, &self.moving] {
            let limit = limit::<V>(packet, found, rays.len());
            let mut leaves = InstancesPacket::<V> {
                world: self,
                order: &tree.order,
                rays,
                lanes,
                packet,
                filter,
                found,
                stack: body,
                vectors: PhantomData,
            };
            walk(&tree.nodes, &frustum, limit, top, &mut leaves);
        }
    }

    /// False when the rays do not go together in the mesh's frame.
    #[inline(always)]
    fn find_mesh_packet<V: V8>(
        &self,
        mesh: &TriangleMesh,
        number: u32,
        rays: &[&Ray],
        found: &mut [Found; 8],
        stack: &mut Stack,
    ) -> bool {
        let frame = &self.instances[number as usize].world_from_body;
        let origin = frame.point_in_body(rays[0].origin_m) - mesh.middle_m;
        let (mut directions, mut min) = ([DVec3::ZERO; 8], Row([0.0; 8]));
        for lane in 0..8 {
            let ray = rays[if lane < rays.len() { lane } else { 0 }];
            directions[lane] = frame.unturn(ray.direction);
            min.0[lane] = single(ray.min_m);
        }
        let Some(packet) = Packet::new::<V>(origin, &directions, min) else { return false };
        let mut best = [start(found)];
        mesh.trace_packets::<V>(&packet.pyramid, std::slice::from_ref(&packet), &mut best, stack);
        for (lane, found) in found.iter_mut().enumerate() {
            if let Some((distance, id)) = best[0].get(lane) {
                found.consider(distance.into(), number, id);
            }
        }
        true
    }
}

/// The nearest that counts, as a ray in a tree's frame has it.
#[inline(always)]
#[expect(clippy::cast_possible_truncation, reason = "single precision is the point")]
fn single(min_m: f64) -> f32 {
    min_m.max(0.0) as f32
}

/// The depth within which any of the first `count` rays may still find something.
#[inline(always)]
fn limit<V: V8>(packet: &Packet, found: &[Found; 8], count: usize) -> f32 {
    let mut row = [0.0; 8];
    for (lane, found) in found[..count].iter().enumerate() {
        row[lane] = single_above(found.distance);
    }
    packet.reach(V::load(&Row(row)), 0.0)
}

/// Eight rays against instances.
struct InstancesPacket<'a, V> {
    world: &'a World,
    order: &'a [u32],
    rays: &'a [&'a Ray],
    lanes: &'a Lanes,
    packet: &'a Packet,
    filter: Filter,
    found: &'a mut [Found; 8],
    stack: &'a mut Stack,
    vectors: PhantomData<V>,
}

impl<V: V8> Leaves for InstancesPacket<'_, V> {
    #[inline(always)]
    fn visit(&mut self, word: u32) -> Step {
        let (first, count) = leaf_range(word);
        for &number in &self.order[first..first + count] {
            let instance = &self.world.instances[number as usize];
            if !self.filter.lets_pass(instance.tags) {
                continue;
            }
            if let Body::Solid(_) = &instance.body {
                let Lanes { origins_m, directions, min, .. } = self.lanes;
                let (filter, found) = (self.filter, &mut *self.found);
                self.world.find_solid_eight::<V>(number, origins_m, directions, min, filter, found);
                continue;
            }
            if let Body::Mesh(mesh) = &instance.body
                && self.world.find_mesh_packet::<V>(mesh, number, self.rays, self.found, self.stack)
            {
                continue;
            }
            for (ray, found) in self.rays.iter().zip(&mut *self.found) {
                self.world.find_instance::<V, false>(number, ray, self.filter, found, self.stack);
            }
        }
        Step::Within(limit::<V>(self.packet, self.found, self.rays.len()))
    }
}

/// What is nearest before any triangle is tested.
#[inline(always)]
fn start(found: &[Found; 8]) -> Best {
    let mut row = [0.0; 8];
    for (own, found) in row.iter_mut().zip(found) {
        *own = single_above(found.distance);
    }
    Best::within(Row(row))
}
