//! 1.5 to 1.6: the noise of an IMU is given for each axis.

use periplus_xml::Element;

use super::take_child;

pub(super) fn spread_noise(imu: &mut Element) {
    let Some(noise) = take_child(imu, "noise") else { return };
    for (from, to) in [("rate", "angular_velocity"), ("accel", "linear_acceleration")] {
        if imu.child(to).is_some() {
            continue;
        }
        let mut group = Element { origin: noise.origin, ..Element::new(to) };
        for axis in ["x", "y", "z"] {
            let kind = noise.child("type").map_or_else(|| "gaussian".into(), Element::text);
            let mut spread = Element { origin: noise.origin, ..Element::new("noise") }
                .with_attribute("type", &*kind);
            for element in noise.child(from).into_iter().flat_map(Element::elements) {
                spread.push(element.clone());
            }
            group.push(Element::new(axis).with_child(spread));
        }
        imu.push(group);
    }
}
