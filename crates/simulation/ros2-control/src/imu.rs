//! Publisher of an inertial sensor: `imu_sensor_broadcaster`.

use crate::{
    ControlCycle, ControllerError, ControllerInterface, InterfaceSelection, LoanedInterfaces,
};

/// State interfaces of an inertial sensor, in order.
const INTERFACES: [&str; 10] = [
    "orientation.x",
    "orientation.y",
    "orientation.z",
    "orientation.w",
    "angular_velocity.x",
    "angular_velocity.y",
    "angular_velocity.z",
    "linear_acceleration.x",
    "linear_acceleration.y",
    "linear_acceleration.z",
];

/// Reading of an inertial sensor.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct ImuInterfaceValues {
    /// Orientation x, y, z, w.
    pub orientation: [f64; 4],
    /// Angular velocity [rad/s].
    pub angular_rad_s: [f64; 3],
    /// Linear acceleration [m/s²].
    pub linear_m_s2: [f64; 3],
}

/// Reads an inertial sensor.
///
/// Source: `imu_sensor_broadcaster.cpp` of `ros2_controllers`.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct ImuBroadcaster {
    /// Name of the sensor.
    pub sensor_name: String,
    /// Reading of the last update.
    pub reading: ImuInterfaceValues,
}

impl ControllerInterface for ImuBroadcaster {
    fn command_interfaces(&self) -> InterfaceSelection {
        InterfaceSelection::Nothing
    }

    fn state_interfaces(&self) -> InterfaceSelection {
        let names = INTERFACES.iter().map(|name| format!("{}/{name}", self.sensor_name));
        InterfaceSelection::Named(names.collect())
    }

    fn configure(&mut self) -> Result<(), ControllerError> {
        if self.sensor_name.is_empty() {
            return Err("`sensor_name` is empty".into());
        }
        Ok(())
    }

    fn activate(
        &mut self,
        interfaces: &mut LoanedInterfaces<'_>,
        cycle: ControlCycle,
    ) -> Result<(), ControllerError> {
        self.update(interfaces, cycle)
    }

    fn update(
        &mut self,
        interfaces: &mut LoanedInterfaces<'_>,
        _: ControlCycle,
    ) -> Result<(), ControllerError> {
        self.reading = ImuInterfaceValues {
            orientation: std::array::from_fn(|index| interfaces.state(index)),
            angular_rad_s: std::array::from_fn(|index| interfaces.state(4 + index)),
            linear_m_s2: std::array::from_fn(|index| interfaces.state(7 + index)),
        };
        Ok(())
    }
}
