//! One step in time.

use rapier3d_f64::prelude::PhysicsPipeline;

use crate::hooks::Hooks;
use crate::joints::Command;
use crate::state::Diverged;
use crate::world::{BodyKind, World};

/// Nothing that a robot meets moves faster [m/s].
const FASTEST_M_S: f64 = 1e4;

impl World {
    /// Moves everything on by a time [s]. Use the same step throughout: 1 ms is what worlds ask for
    /// and what the tests hold. A step that is no positive number does nothing.
    ///
    /// # Errors
    /// When a body's motion is no longer finite, or absurdly fast. The world then stands still until
    /// [`Self::reset`]; each further step gives the same answer.
    pub fn step(&mut self, dt_s: f64) -> Result<(), Diverged> {
        if let Some(diverged) = &self.diverged {
            return Err(diverged.clone());
        }
        if !(dt_s.is_finite() && dt_s > 0.0) {
            return Ok(());
        }
        self.solver.integration_parameters.dt = dt_s;
        let records = &mut self.records;
        for number in 0..records.axes.len() {
            let leader =
                records.axes[number].follows.map(|follow| records.axes[follow.leader].state);
            records.axes[number].drive(
                leader,
                dt_s,
                &mut self.solver.impulse_joints,
                &mut self.solver.bodies,
                &records.bodies,
            );
        }
        self.solver.step_with_events(&Hooks { model_of_link: &self.model_of_link }, &());
        self.time_s += dt_s;
        let substep_s = self.substep_s();
        let records = &mut self.records;
        let mut pushed = false;
        for axis in &mut records.axes {
            axis.observe(
                substep_s,
                &self.solver.impulse_joints,
                &self.solver.bodies,
                &records.bodies,
            );
            pushed |= matches!(axis.command, Command::Effort(_));
        }
        if pushed || self.pushed {
            self.clear_pushes();
        }
        self.watch()
    }

    fn clear_pushes(&mut self) {
        self.pushed = false;
        for body in &self.records.bodies {
            if body.kind == BodyKind::Dynamic
                && let Some(handle) = body.handle
            {
                self.solver.bodies[handle].reset_forces(false);
                self.solver.bodies[handle].reset_torques(false);
            }
        }
    }

    /// Finds the first body whose motion is none.
    fn watch(&mut self) -> Result<(), Diverged> {
        let lost = PhysicsPipeline::quarantine(&self.solver.physics_pipeline).bodies();
        for body in &self.records.bodies {
            let Some(handle) = body.handle.filter(|_| body.kind == BodyKind::Dynamic) else {
                continue;
            };
            let found = &self.solver.bodies[handle];
            let speed = found.linvel().length();
            let finite = speed.is_finite() && found.translation().is_finite();
            let speed_m_s = match (finite && !lost.contains(&handle), speed > FASTEST_M_S) {
                (true, false) => continue,
                (true, true) => Some(speed),
                (false, _) => None,
            };
            let diverged = Diverged { link: body.name.clone(), time_s: self.time_s, speed_m_s };
            self.diverged = Some(diverged.clone());
            return Err(diverged);
        }
        Ok(())
    }
}
