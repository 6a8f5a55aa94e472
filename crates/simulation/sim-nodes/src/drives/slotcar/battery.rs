//! The battery of a slotcar.

use periplus_geometry::DVec3;
use periplus_scene::World;

use crate::drives::BuildContext;

/// Acceleration of gravity \[m/s²\].
const GRAVITY_M_S2: f64 = 9.81;

/// Distance from a charger within which a robot charges \[m\].
const CHARGER_RANGE_M: f64 = 0.3;

/// Battery, what draws on it, and the chargers of the world.
#[derive(Clone, Debug)]
pub(super) struct Battery {
    voltage_v: f64,
    capacity_ah: f64,
    mass_kg: f64,
    inertia_kg_m2: f64,
    friction: f64,
    power_w: f64,
    charging_a: f64,
    /// Positions in the world \[m\].
    chargers: Vec<DVec3>,
}

/// Motion of a step.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct BatteryLoad {
    speed_m_s: f64,
    rate_rad_s: f64,
    acceleration_m_s2: f64,
    angular_acceleration_rad_s2: f64,
}

impl BatteryLoad {
    /// Motion between two pairs of speeds \[m/s, rad/s\].
    pub(super) fn between(before: [f64; 2], after: [f64; 2], step_s: f64) -> Self {
        let change = |axis: usize| (after[axis] - before[axis]).abs() / step_s;
        Self {
            speed_m_s: after[0].abs(),
            rate_rad_s: after[1].abs(),
            acceleration_m_s2: change(0),
            angular_acceleration_rad_s2: change(1),
        }
    }
}

impl Battery {
    pub(super) fn read(context: &BuildContext<'_>) -> Self {
        Self {
            voltage_v: context.number("nominal_voltage"),
            capacity_ah: context.number("nominal_capacity"),
            mass_kg: context.number("mass"),
            inertia_kg_m2: context.number("inertia"),
            friction: context.number("friction_coefficient"),
            power_w: context.number("nominal_power"),
            charging_a: context.number("charging_current"),
            chargers: chargers(context.setting.scene),
        }
    }

    /// True within range of a charger.
    pub(super) fn is_at_charger(&self, at_m: DVec3) -> bool {
        self.chargers.iter().any(|charger| charger.distance(at_m) < CHARGER_RANGE_M)
    }

    /// Charge after a step at a charger.
    pub(super) fn charged(&self, charge_ratio: f64, step_s: f64) -> f64 {
        let gained = self.charging_a * step_s / (self.capacity_ah * 3600.0);
        if gained.is_finite() { (charge_ratio + gained).min(1.0) } else { charge_ratio }
    }

    /// Charge after a step, as a part of the capacity: power of acceleration `m a v + I α ω`, of friction `μ m g v`, and
    /// of the electronics.
    pub(super) fn drained(&self, charge_ratio: f64, load: &BatteryLoad, step_s: f64) -> f64 {
        let acceleration_w = self.mass_kg * load.acceleration_m_s2 * load.speed_m_s
            + self.inertia_kg_m2 * load.angular_acceleration_rad_s2 * load.rate_rad_s;
        let friction_w = self.friction * self.mass_kg * GRAVITY_M_S2 * load.speed_m_s;
        let current_a = (acceleration_w + friction_w + self.power_w) / self.voltage_v;
        let drawn = current_a * step_s / (self.capacity_ah * 3600.0);
        if drawn.is_finite() { (charge_ratio - drawn).max(0.0) } else { charge_ratio }
    }
}

/// Chargers of a world: elements `rmf_charger` of its component `Chargers`.
fn chargers(world: &World) -> Vec<DVec3> {
    let components = world.plugins.iter().flat_map(|plugin| &plugin.content);
    let of_chargers = components.filter(|it| it.value("name") == Some("Chargers"));
    let chargers = of_chargers.flat_map(|component| component.named("rmf_charger"));
    let number = |text: Option<&str>| text.and_then(|text| text.trim().parse::<f64>().ok());
    let position = |charger: &periplus_xml::Element| {
        let [x, y, z] = ["x", "y", "z"].map(|axis| number(charger.value(axis)));
        Some(DVec3::new(x?, y?, z?))
    };
    chargers.filter_map(position).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn an_hour_of_the_electronics_draws_their_share() {
        let battery = Battery {
            voltage_v: 12.0,
            capacity_ah: 24.0,
            mass_kg: 20.0,
            inertia_kg_m2: 10.0,
            friction: 0.2,
            power_w: 24.0,
            charging_a: 6.0,
            chargers: vec![DVec3::new(1.0, 0.0, 0.0)],
        };
        assert!(battery.is_at_charger(DVec3::new(1.2, 0.0, 0.0)));
        assert!(!battery.is_at_charger(DVec3::new(1.4, 0.0, 0.0)));
        // 6 A of 24 A h for an hour.
        assert!((battery.charged(0.5, 3600.0) - 0.75).abs() < 1e-12);
        assert_eq!(battery.charged(0.9, 3600.0), 1.0);
        // 24 W at 12 V: 2 A of 24 A h.
        let standing = battery.drained(1.0, &BatteryLoad::default(), 3600.0);
        assert!((standing - (1.0 - 1.0 / 12.0)).abs() < 1e-12);
        // 0.2 * 20 * 9.81 * 1 = 39.24 W more.
        let driving = BatteryLoad::between([1.0, 0.0], [1.0, 0.0], 1.0);
        let after = battery.drained(1.0, &driving, 3600.0);
        assert!((after - (1.0 - (24.0 + 39.24) / 12.0 / 24.0)).abs() < 1e-12);
        assert_eq!(battery.drained(0.0, &driving, 1.0), 0.0);
    }
}
