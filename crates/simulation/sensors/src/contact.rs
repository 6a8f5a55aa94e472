//! Contact sensors.

use periplus_physics::{CollisionId, PhysicsContact};

/// Returns the contacts of a sensor's collisions from the sensor's side: `one` is the sensor's own
/// collision, and the normal points away from it. A contact between two own collisions is reported
/// once.
#[must_use]
pub fn contacts_of(
    contacts: &[PhysicsContact],
    is_own: impl Fn(CollisionId) -> bool,
) -> Vec<PhysicsContact> {
    let own = |contact: &PhysicsContact| {
        if is_own(contact.one) {
            Some(contact.clone())
        } else if is_own(contact.two) {
            let PhysicsContact { one, two, normal, .. } = *contact;
            Some(PhysicsContact { one: two, two: one, normal: -normal, ..contact.clone() })
        } else {
            None
        }
    };
    contacts.iter().filter_map(own).collect()
}

#[cfg(test)]
mod tests {
    use periplus_geometry::{DVec3, Pose};
    use periplus_physics::{NoMeshes, PhysicsMode, PhysicsWorld};
    use periplus_scene::{Collision, Link, Model, Shape};

    use super::*;

    fn model(name: &str, shape: Shape, is_static: bool) -> Model {
        let mut link = Link::new("link");
        link.collisions.push(Collision::new("collision", shape));
        let mut model = Model::new(name);
        (model.is_static, model.canonical_link) = (is_static, Some("link".into()));
        model.links.push(link);
        model
    }

    /// A ball of 1 kg on the floor: seen from either side, the other presses with 9.8 N.
    #[test]
    fn contacts_are_seen_from_the_sensors_side() {
        let mut world = PhysicsWorld::empty(DVec3::Z * -9.8, PhysicsMode::Rigid);
        let floor = model("floor", Shape::Box { size_m: DVec3::new(9.0, 9.0, 1.0) }, true);
        let ball = model("ball", Shape::Sphere { radius_m: 0.5 }, false);
        let floor = world.add(&floor, Pose::from_xyz(0.0, 0.0, -0.5), &NoMeshes).model.unwrap();
        let ball = world.add(&ball, Pose::from_xyz(0.0, 0.0, 0.5), &NoMeshes).model.unwrap();
        for _ in 0..500 {
            world.step(1_000_000).unwrap();
        }
        let contacts = world.contacts();
        for (own, normal) in [(floor, DVec3::Z), (ball, DVec3::NEG_Z)] {
            let link = world.links(own).next().unwrap();
            let seen = contacts_of(&contacts, |touching| touching.link == link);
            assert_eq!(seen.len(), 1);
            assert_eq!((seen[0].one.link, seen[0].one.collision), (link, 0));
            assert!(seen[0].normal.distance(normal) < 1e-6, "{:?}", seen[0]);
            assert!((seen[0].force_n - 9.8).abs() < 0.1, "{:?}", seen[0]);
        }
        assert!(contacts_of(&contacts, |_| false).is_empty());
    }
}
