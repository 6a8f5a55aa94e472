//! One step of the solver.

use rapier3d_f64::prelude::PhysicsPipeline;

use super::Rigid;
use crate::hooks::Hooks;
use crate::joints::JointCommand;
use crate::limits::MAX_SPEED_M_S;
use crate::records::{BodyKind, Records};

/// A body with a diverged motion, and its speed [m/s] if finite.
pub(crate) struct DivergedBody {
    pub(crate) body: usize,
    pub(crate) speed_m_s: Option<f64>,
}

impl Rigid {
    /// Advances by a time [s], and reads the states of the axes.
    pub(crate) fn step(&mut self, records: &mut Records, dt_s: f64) -> Result<(), DivergedBody> {
        self.solver.integration_parameters.dt = dt_s;
        for number in 0..records.axes.len() {
            let leader =
                records.axes[number].mimics.map(|follow| records.axes[follow.leader].state);
            records.axes[number].drive(leader, dt_s, self.axes[number], self, &records.bodies);
        }
        self.apply_friction(dt_s);
        let hooks = Hooks {
            model_of_link: &records.model_of_link,
            links: &records.links,
            parameters: self.solver.integration_parameters,
        };
        self.solver.step_with_events(&hooks, &());
        let mut has_external_forces = false;
        for (number, axis) in records.axes.iter_mut().enumerate() {
            axis.observe(self.axes[number], self);
            has_external_forces |= matches!(axis.command, JointCommand::Effort(_));
        }
        if has_external_forces || self.has_external_forces {
            self.clear_forces();
        }
        self.check_finite(records)
    }

    fn clear_forces(&mut self) {
        self.has_external_forces = false;
        for handle in self.bodies.iter().flatten() {
            let body = &mut self.solver.bodies[*handle];
            if body.is_dynamic() {
                body.reset_forces(false);
                body.reset_torques(false);
            }
        }
    }

    /// Returns the first body with a diverged motion as an error.
    fn check_finite(&self, records: &Records) -> Result<(), DivergedBody> {
        let lost = PhysicsPipeline::quarantine(&self.solver.physics_pipeline).bodies();
        for (number, handle) in self.bodies.iter().enumerate() {
            let Some(handle) = handle.filter(|_| records.bodies[number].kind == BodyKind::Dynamic)
            else {
                continue;
            };
            let found = &self.solver.bodies[handle];
            let speed = found.linvel().length();
            let finite = speed.is_finite() && found.translation().is_finite();
            let speed_m_s = match (finite && !lost.contains(&handle), speed > MAX_SPEED_M_S) {
                (true, false) => continue,
                (true, true) => Some(speed),
                (false, _) => None,
            };
            return Err(DivergedBody { body: number, speed_m_s });
        }
        Ok(())
    }
}
