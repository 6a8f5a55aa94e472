//! Services of gravity, step and real-time factor.

use periplus_graph::{GraphError, Node};
use periplus_msgs::gazebo_msgs::{
    GetPhysicsProperties, GetPhysicsPropertiesResponse, ODEPhysics, SetPhysicsProperties,
    SetPhysicsPropertiesRequest, SetPhysicsPropertiesResponse,
};
use periplus_physics::limits::{MAX_GRAVITY_M_S2, STEP_RANGE_S, is_within};

use super::convert::{vector, vector_message};
use super::pause_state::PauseState;
use super::properties::names;
use super::service_aliases::ServiceAliases;
use super::state_plugin::StatePlugin;
use crate::Simulation;

/// Maximum update rate \[Hz\].
const MAX_UPDATE_RATE_HZ: f64 = 1e9;

pub(super) struct Physics {
    get: ServiceAliases<GetPhysicsProperties>,
    set: ServiceAliases<SetPhysicsProperties>,
}

/// Real-time factor; `None` is unlimited.
pub(crate) type Factor = Option<f64>;

impl Physics {
    pub(super) fn new(
        node: &Node,
        plugins: &[StatePlugin],
        of_world: &str,
    ) -> Result<Self, GraphError> {
        let mut set = names(plugins, "set_physics_properties");
        set.push(of_world.to_owned());
        let get = names(plugins, "get_physics_properties");
        Ok(Self {
            get: ServiceAliases::new(node, get.iter().map(String::as_str))?,
            set: ServiceAliases::new(node, set.iter().map(String::as_str))?,
        })
    }

    /// Answers requests; returns a new real-time factor, if requested.
    pub(super) fn serve(&self, simulation: &mut Simulation, tempo: PauseState) -> Option<Factor> {
        let mut new_factor = None;
        self.set.answer(|asked| match set(simulation, asked) {
            Ok((factor, note)) => {
                new_factor = Some(factor);
                let status_message = format!("physics engine updated{note}");
                SetPhysicsPropertiesResponse { success: true, status_message }
            }
            Err(status_message) => SetPhysicsPropertiesResponse { success: false, status_message },
        });
        self.get.answer(|_| {
            let physics = simulation.physics();
            GetPhysicsPropertiesResponse {
                time_step: simulation.step_s(),
                pause: tempo.is_paused(),
                max_update_rate: physics.real_time_update_rate_hz,
                gravity: vector_message(simulation.motion().gravity_m_s2()),
                ode_config: ODEPhysics {
                    max_contacts: physics.max_contacts,
                    ..ODEPhysics::default()
                },
                success: true,
                status_message: "GetPhysicsProperties: got properties; ode_config is not used, \
                                 but for max_contacts"
                    .into(),
            }
        });
        new_factor
    }
}

fn set(
    simulation: &mut Simulation,
    asked: &SetPhysicsPropertiesRequest,
) -> Result<(Factor, &'static str), String> {
    let SetPhysicsPropertiesRequest { time_step, max_update_rate, gravity, ode_config } = asked;
    let gravity = vector(gravity);
    if !is_within(gravity, MAX_GRAVITY_M_S2) {
        return Err(format!(
            "`gravity` contains a value that is not finite, or beyond {MAX_GRAVITY_M_S2} \
             m/s²"
        ));
    }
    let [shortest_s, longest_s] = STEP_RANGE_S;
    if !(shortest_s..=longest_s).contains(time_step) {
        return Err(format!(
            "`time_step` is {time_step}; it must be from {shortest_s} s to {longest_s} s. All \
             fields count: ask get_physics_properties first and change what you want"
        ));
    }
    if !(0.0..=MAX_UPDATE_RATE_HZ).contains(max_update_rate) {
        return Err(format!(
            "`max_update_rate` is {max_update_rate}; it must be a rate of at most \
             {MAX_UPDATE_RATE_HZ} Hz, or 0 for as fast as possible"
        ));
    }
    simulation.set_step(*time_step);
    simulation.set_gravity(gravity);
    simulation.physics_mut().real_time_update_rate_hz = *max_update_rate;
    let usual =
        ODEPhysics { max_contacts: simulation.physics().max_contacts, ..ODEPhysics::default() };
    let is_usual = *ode_config == usual || *ode_config == ODEPhysics::default();
    let note = if is_usual { "" } else { "; ode_config was ignored: the engine is not ODE" };
    let factor = max_update_rate * time_step;
    Ok(((factor > 0.0).then_some(factor), note))
}
