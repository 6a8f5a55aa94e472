//! Groups of packets with a common origin.

use std::marker::PhantomData;

use periplus_geometry::DVec3;

use super::lanes::Lanes;
use super::query::{FindInstance, NearestHit, Scratch, directions, single_above, to_f32};
use super::{Filter, InstanceGeometry, RaycastWorld};
use crate::bvh::leaf_range;
use crate::mesh::{Best, GroupStack, TriangleMesh};
use crate::packet::{Frustum, MAX_GROUP_COUNT, Packet, Pyramid};
use crate::ray::Ray;
use crate::simd::{Row, Task, V8};
use crate::traversal::{Leaves, Stack, Step, traverse};

/// Up to eight packets, and the pyramid around them.
pub(super) struct PacketGroup {
    pyramid: Option<Pyramid>,
    packets: Vec<Packet>,
    members: Vec<Member>,
    /// Filled only in worlds with instances.
    lanes: Vec<Lanes>,
    /// Nearest hits of the rays that were traced last.
    found: [[NearestHit; 8]; MAX_GROUP_COUNT],
}

/// Indices of the rays of a packet; lanes beyond `count` repeat the first.
#[derive(Clone, Copy)]
pub(super) struct Member {
    slots: [usize; 8],
    count: usize,
    /// True if no ray has a maximum distance.
    endless: bool,
}

impl PacketGroup {
    pub(super) fn new() -> Self {
        Self {
            pyramid: None,
            packets: Vec::with_capacity(MAX_GROUP_COUNT),
            members: Vec::with_capacity(MAX_GROUP_COUNT),
            lanes: Vec::new(),
            found: [[NearestHit::nothing(0.0); 8]; MAX_GROUP_COUNT],
        }
    }

    /// Returns true if a packet fits into a pyramid of at most this slope spread.
    #[inline(always)]
    pub(super) fn fits(&self, packet: &Packet, widest: f32) -> bool {
        let Some(own) = &self.pyramid else { return true };
        self.packets.len() < MAX_GROUP_COUNT
            && own.with(&packet.pyramid).is_some_and(|all| all.spread() <= widest)
    }

    #[inline(always)]
    pub(super) fn push(&mut self, packet: Packet, member: Member) {
        let own = self.pyramid.and_then(|own| own.with(&packet.pyramid));
        self.pyramid = Some(own.unwrap_or(packet.pyramid));
        self.packets.push(packet);
        self.members.push(member);
    }

    /// Traces all packets.
    #[inline(always)]
    fn trace<V: V8>(
        &mut self,
        world: &RaycastWorld,
        fixed: &TriangleMesh,
        rays: &[Ray],
        filter: Filter,
        scratch: &mut Scratch,
    ) {
        let Some(pyramid) = self.pyramid.take() else { return };
        let instances = world.has_instances();
        let others = instances || !world.endless.is_empty();
        let count = self.packets.len().min(MAX_GROUP_COUNT);
        let found = &mut self.found[..count];
        let mut best = [Best::within(Row([f32::INFINITY; 8])); MAX_GROUP_COUNT];
        for ((member, found), best) in self.members.iter().zip(&mut *found).zip(&mut best) {
            if others {
                let lanes = Lanes::new(&member.rays(rays));
                *found = lanes.nothing();
                for &number in &world.endless {
                    let Lanes { origins_m, directions, min, .. } = &lanes;
                    world.find_solid8::<V>(number, origins_m, directions, min, filter, found);
                }
                self.lanes.push(lanes);
            } else if member.endless {
                *found = [NearestHit::nothing(f64::INFINITY); 8];
                continue;
            } else {
                for (found, &index) in found.iter_mut().zip(&member.slots) {
                    *found = NearestHit::nothing(rays[index].max_m);
                }
            }
            *best = start(found);
        }
        if !fixed.nodes.is_empty() {
            let best = &mut best[..count];
            fixed.trace_packets::<V>(&pyramid, &self.packets, best, &mut scratch.group);
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
            for (((member, packet), lanes), found) in members.zip(found) {
                let all = member.rays(rays);
                let rays = &all[..member.count];
                world.find_instances_packet::<V>(rays, lanes, packet, filter, found, scratch);
            }
        }
    }

    /// Reports the nearest hit of each ray, and clears the group.
    #[inline(always)]
    pub(super) fn report(&mut self, first: usize, report: &mut impl FnMut(usize, &NearestHit)) {
        for (member, found) in self.members.iter().zip(&self.found) {
            for (&index, found) in member.slots[..member.count].iter().zip(found) {
                report(first + index, found);
            }
        }
        self.packets.clear();
        self.members.clear();
        self.lanes.clear();
    }
}

/// Tracing of all packets of a group.
pub(super) struct TraceGroup<'a> {
    pub(super) group: &'a mut PacketGroup,
    pub(super) world: &'a RaycastWorld,
    /// The fixed triangles that the rays can meet.
    pub(super) fixed: &'a TriangleMesh,
    pub(super) rays: &'a [Ray],
    pub(super) filter: Filter,
    pub(super) scratch: &'a mut Scratch,
}

impl Task for TraceGroup<'_> {
    type Output = ();

    #[inline(always)]
    fn run<V: V8>(self) {
        let Self { group, world, fixed, rays, filter, scratch } = self;
        group.trace::<V>(world, fixed, rays, filter, scratch);
    }
}

impl Member {
    #[inline(always)]
    fn rays<'a>(&self, rays: &'a [Ray]) -> [&'a Ray; 8] {
        let mut own = [&rays[self.slots[0]]; 8];
        for (own, &index) in own.iter_mut().zip(&self.slots) {
            *own = &rays[index];
        }
        own
    }
}

impl RaycastWorld {
    /// Returns up to eight rays as a packet in the frame of the fixed triangles, if they are sound,
    /// have a common origin and a common dominant axis.
    #[inline(always)]
    pub(super) fn packet_of<V: V8>(
        &self,
        rays: &[Ray],
        picked: &[usize],
    ) -> Option<(Packet, Member)> {
        let first = *picked.first()?;
        let mut member = Member { slots: [first; 8], count: picked.len(), endless: true };
        let lead = &rays[first];
        let mut own = [lead; 8];
        let mut min = Row([to_f32(lead.min_m); 8]);
        let mut fits = true;
        for (lane, &index) in picked.iter().enumerate().take(8) {
            let ray = &rays[index];
            member.slots[lane] = index;
            own[lane] = ray;
            fits &= (ray.origin_m == lead.origin_m) & ray.is_sound();
            member.endless &= ray.max_m == f64::INFINITY;
            min.0[lane] = to_f32(ray.min_m);
        }
        if !fits {
            return None;
        }
        let origin = lead.origin_m - self.fixed.middle_m;
        let packet = Packet::new::<V>(origin, directions(own), min)?;
        Some((packet, member))
    }

    /// `packet` is in the frame of the fixed triangles, which is the frame of the instance trees.
    #[inline(always)]
    fn find_instances_packet<V: V8>(
        &self,
        rays: &[&Ray],
        lanes: &Lanes,
        packet: &Packet,
        filter: Filter,
        found: &mut [NearestHit; 8],
        scratch: &mut Scratch,
    ) {
        let frustum = Frustum::<V>::new(&packet.pyramid, 0.0);
        let Scratch { top, body, group } = scratch;
        for tree in [&self.resting, &self.moving] {
            let limit = limit::<V>(packet, found, rays.len());
            let mut leaves = InstancePacketLeaves::<V> {
                world: self,
                order: &tree.order,
                rays,
                lanes,
                packet,
                filter,
                found,
                stack: body,
                group,
                vectors: PhantomData,
            };
            traverse(&tree.nodes, &frustum, limit, top, &mut leaves);
        }
    }

    /// Returns false when the rays cannot form a packet in the mesh's frame.
    #[inline(always)]
    fn find_mesh_packet<V: V8>(
        &self,
        mesh: &TriangleMesh,
        number: u32,
        rays: &[&Ray],
        found: &mut [NearestHit; 8],
        stack: &mut GroupStack,
    ) -> bool {
        let frame = &self.instances[number as usize].world_from_body;
        let origin = frame.point_in_body(rays[0].origin_m) - mesh.middle_m;
        let (mut turned, mut min) = ([DVec3::ZERO; 8], Row([0.0; 8]));
        for lane in 0..8 {
            let ray = rays[if lane < rays.len() { lane } else { 0 }];
            turned[lane] = frame.rotate_into_body(ray.direction);
            min.0[lane] = to_f32(ray.min_m);
        }
        let Some(packet) = Packet::new::<V>(origin, turned.each_ref(), min) else { return false };
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

/// Returns the depth within which any of the first `count` rays can still find a hit.
#[inline(always)]
fn limit<V: V8>(packet: &Packet, found: &[NearestHit; 8], count: usize) -> f32 {
    let mut row = [0.0; 8];
    for (lane, found) in found[..count].iter().enumerate() {
        row[lane] = single_above(found.distance);
    }
    packet.reach(V::load(&Row(row)), 0.0)
}

/// Eight rays against instances.
struct InstancePacketLeaves<'a, V> {
    world: &'a RaycastWorld,
    order: &'a [u32],
    rays: &'a [&'a Ray],
    lanes: &'a Lanes,
    packet: &'a Packet,
    filter: Filter,
    found: &'a mut [NearestHit; 8],
    stack: &'a mut Stack,
    group: &'a mut GroupStack,
    vectors: PhantomData<V>,
}

impl<V: V8> Leaves for InstancePacketLeaves<'_, V> {
    #[inline(always)]
    fn visit(&mut self, word: u32) -> Step {
        let (first, count) = leaf_range(word);
        for &number in &self.order[first..first + count] {
            let instance = &self.world.instances[number as usize];
            if !self.filter.accepts(instance.tags) {
                continue;
            }
            if let InstanceGeometry::Solid(_) = &instance.body {
                let Lanes { origins_m, directions, min, .. } = self.lanes;
                let (filter, found) = (self.filter, &mut *self.found);
                self.world.find_solid8::<V>(number, origins_m, directions, min, filter, found);
                continue;
            }
            if let InstanceGeometry::Mesh(mesh) = &instance.body
                && self.world.find_mesh_packet::<V>(mesh, number, self.rays, self.found, self.group)
            {
                continue;
            }
            for (ray, found) in self.rays.iter().zip(&mut *self.found) {
                let (world, filter, stack) = (self.world, self.filter, &mut *self.stack);
                V::run(FindInstance { world, number, ray, filter, found, stack });
            }
        }
        Step::Within(limit::<V>(self.packet, self.found, self.rays.len()))
    }
}

/// Returns the nearest hits before any triangle is tested.
#[inline(always)]
fn start(found: &[NearestHit; 8]) -> Best {
    let mut row = [0.0; 8];
    for (own, found) in row.iter_mut().zip(found) {
        *own = single_above(found.distance);
    }
    Best::within(Row(row))
}
