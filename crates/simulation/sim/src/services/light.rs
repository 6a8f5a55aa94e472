//! Services of lights.

use std::sync::Arc;

use periplus_geometry::DVec3;
use periplus_msgs::ros_gz_interfaces;
use periplus_scene::{Attenuation, Light, LightKind, Spot};

use super::convert::BAD_POSE;
use super::convert::{colour, pose, vector};
use super::spawn::lights;
use crate::Simulation;

/// Finds a light by name, or by `model::link::light`.
///
/// # Errors
/// The unknown name and the known ones.
pub(super) fn light<'a>(
    simulation: &'a mut Simulation,
    name: &str,
) -> Result<&'a mut Light, String> {
    let place = simulation.scene.lights.iter().position(|light| light.name == name);
    let unknown = || format!("there is no light `{name}`");
    if let Some(place) = place {
        return Ok(&mut Arc::make_mut(&mut simulation.scene).lights[place]);
    }
    let known = format!(
        "{} ({}; one on a link is written model::link::light)",
        unknown(),
        lights(simulation)
    );
    let mut parts = name.split("::");
    let (Some(model), Some(link), Some(light)) = (parts.next(), parts.next(), parts.next()) else {
        return Err(known);
    };
    let links = simulation
        .running
        .iter_mut()
        .filter(|running| running.member.name == model)
        .flat_map(|running| &mut Arc::make_mut(&mut running.member).model.links);
    let mut lights = links.filter(|one| one.name == link).flat_map(|one| &mut one.lights);
    lights.find(|one| one.name == light).ok_or(known)
}

/// Checks the attenuation of a light.
pub(super) fn attenuation(constant: f64, linear: f64, quadratic: f64) -> Result<[f64; 3], String> {
    let factors = [constant, linear, quadratic];
    if factors.iter().all(|factor| factor.is_finite() && *factor >= 0.0) {
        return Ok(factors);
    }
    Err("attenuation must be numbers of at least 0".into())
}

/// Sets all properties of a light, like Harmonic's `light_config`.
///
/// # Errors
/// The invalid field of the message.
pub(super) fn configure(
    simulation: &mut Simulation,
    message: &ros_gz_interfaces::Light,
) -> Result<(), String> {
    let known = light(simulation, &message.name)?;
    let parent_from_light = pose(&message.pose).ok_or(BAD_POSE)?;
    let [constant, linear, quadratic] = attenuation(
        message.attenuation_constant.into(),
        message.attenuation_linear.into(),
        message.attenuation_quadratic.into(),
    )?;
    let (range_m, intensity) = (f64::from(message.range), f64::from(message.intensity));
    if !(range_m >= 0.0 && intensity >= 0.0 && intensity.is_finite()) {
        return Err("range and intensity must be numbers of at least 0".into());
    }
    let direction = vector(&message.direction);
    known.kind = match message.r#type {
        ros_gz_interfaces::Light::POINT => LightKind::Point,
        ros_gz_interfaces::Light::DIRECTIONAL => LightKind::Directional,
        ros_gz_interfaces::Light::SPOT => LightKind::Spot(Spot {
            inner_angle_rad: message.spot_inner_angle.into(),
            outer_angle_rad: message.spot_outer_angle.into(),
            falloff: message.spot_falloff.into(),
        }),
        other => {
            return Err(format!("{other} is not a type of light: 0 point, 1 spot, 2 directional"));
        }
    };
    known.parent_from_light = parent_from_light;
    if direction.is_finite() && direction != DVec3::ZERO {
        known.direction_in_light = direction;
    }
    known.diffuse = colour(&message.diffuse);
    known.specular = colour(&message.specular);
    known.attenuation = Attenuation { range_m, constant, linear, quadratic };
    known.cast_shadows = message.cast_shadows;
    known.intensity = intensity;
    simulation.show_light(&message.name);
    Ok(())
}
