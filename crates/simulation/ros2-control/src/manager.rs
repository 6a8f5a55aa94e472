//! Loading, switching and updating of controllers.

use crate::{ControlCycle, ControllerError, Hardware, LoanedInterfaces};

/// Interfaces that a controller needs.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub enum InterfaceSelection {
    /// No interfaces.
    #[default]
    Nothing,
    /// All interfaces of the hardware.
    All,
    /// These interfaces, all of which must exist.
    Named(Vec<String>),
}

/// A controller.
///
/// Source: `controller_interface::ControllerInterface` of ROS 2.
pub trait ControllerInterface {
    /// Returns the command interfaces that it claims while it is active.
    fn command_interfaces(&self) -> InterfaceSelection;

    /// Returns the state interfaces that it reads.
    fn state_interfaces(&self) -> InterfaceSelection;

    /// Reads and checks the parameters.
    ///
    /// # Errors
    /// The reason, when a parameter is not usable.
    fn configure(&mut self) -> Result<(), ControllerError> {
        Ok(())
    }

    /// Begins to control.
    ///
    /// # Errors
    /// The reason, when it cannot begin.
    fn activate(
        &mut self,
        interfaces: &mut LoanedInterfaces<'_>,
        cycle: ControlCycle,
    ) -> Result<(), ControllerError>;

    /// Computes the commands of a cycle.
    ///
    /// # Errors
    /// The reason, after which the controller is deactivated.
    fn update(
        &mut self,
        interfaces: &mut LoanedInterfaces<'_>,
        cycle: ControlCycle,
    ) -> Result<(), ControllerError>;

    /// Ends to control; the interfaces are free afterwards.
    fn deactivate(&mut self, _interfaces: &mut LoanedInterfaces<'_>) {}
}

/// Lifecycle state of a controller.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum ControllerLifecycle {
    /// Loaded.
    #[default]
    Unconfigured,
    /// Configured.
    Inactive,
    /// Updated in each cycle.
    Active,
}

impl ControllerLifecycle {
    /// Returns the label in ROS.
    #[must_use]
    pub fn label(self) -> &'static str {
        match self {
            Self::Unconfigured => "unconfigured",
            Self::Inactive => "inactive",
            Self::Active => "active",
        }
    }
}

/// A controller of a [`ControllerManager`].
#[derive(Debug)]
pub struct LoadedController<C> {
    /// Name.
    pub name: String,
    /// Class.
    pub class: String,
    /// State; the manager changes it.
    pub lifecycle: ControllerLifecycle,
    /// The controller itself.
    pub controller: C,
    commands: Vec<usize>,
    states: Vec<usize>,
}

/// Handling of controllers that cannot be switched.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum SwitchStrictness {
    /// Switches the others.
    #[default]
    BestEffort,
    /// Switches none.
    Strict,
    /// Also deactivates active controllers that claim the same interfaces.
    ForceAuto,
}

/// Controllers to switch.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct SwitchRequest {
    /// Controllers to activate.
    pub activate: Vec<String>,
    /// Controllers to deactivate.
    pub deactivate: Vec<String>,
    /// Handling of problems.
    pub strictness: SwitchStrictness,
}

/// Reasons for which a switch did nothing, or a controller cannot be loaded or configured.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct SwitchRefused {
    /// One sentence for each problem.
    pub reasons: Vec<String>,
}

impl SwitchRefused {
    fn one(reason: String) -> Self {
        Self { reasons: vec![reason] }
    }
}

impl std::fmt::Display for SwitchRefused {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.write_str(&self.reasons.join("; "))
    }
}

impl std::error::Error for SwitchRefused {}

/// A controller whose update failed and that is inactive since.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct UpdateFailure {
    /// Name of the controller.
    pub controller: String,
    /// Its reason.
    pub reason: String,
}

/// Controllers on a hardware. A command interface belongs to at most one active controller.
#[derive(Debug)]
pub struct ControllerManager<C> {
    /// Interfaces; read states into it before an update, and write its commands afterwards.
    pub hardware: Hardware,
    controllers: Vec<LoadedController<C>>,
}

impl<C: ControllerInterface> ControllerManager<C> {
    /// Creates a manager without controllers.
    #[must_use]
    pub fn new(hardware: Hardware) -> Self {
        Self { hardware, controllers: Vec::new() }
    }

    /// Returns the controllers in the order of loading.
    #[must_use]
    pub fn controllers(&self) -> &[LoadedController<C>] {
        &self.controllers
    }

    /// Returns the controllers for access to their own data.
    pub fn controllers_mut(&mut self) -> impl Iterator<Item = &mut LoadedController<C>> {
        self.controllers.iter_mut()
    }

    /// Returns a controller by its name.
    #[must_use]
    pub fn find(&self, name: &str) -> Option<&LoadedController<C>> {
        self.controllers.iter().find(|one| one.name == name)
    }

    /// Adds a controller.
    ///
    /// # Errors
    /// When the name is in use.
    pub fn load(
        &mut self,
        name: impl Into<String>,
        class: impl Into<String>,
        controller: C,
    ) -> Result<(), SwitchRefused> {
        let name = name.into();
        if self.find(&name).is_some() {
            return Err(SwitchRefused::one(format!("a controller `{name}` is already loaded")));
        }
        self.controllers.push(LoadedController {
            name,
            class: class.into(),
            lifecycle: ControllerLifecycle::Unconfigured,
            controller,
            commands: Vec::new(),
            states: Vec::new(),
        });
        Ok(())
    }

    /// Configures a controller that is not active.
    ///
    /// # Errors
    /// When there is no such controller, it is active, or it refuses its parameters.
    pub fn configure(&mut self, name: &str) -> Result<(), SwitchRefused> {
        let loaded = names(&self.controllers);
        let one = self.controllers.iter_mut().find(|one| one.name == name);
        let Some(one) = one else { return Err(SwitchRefused::one(unknown(name, &loaded))) };
        if one.lifecycle == ControllerLifecycle::Active {
            let reason = format!("`{name}` is active; deactivate it before it is configured");
            return Err(SwitchRefused::one(reason));
        }
        match one.controller.configure() {
            Ok(()) => {
                one.lifecycle = ControllerLifecycle::Inactive;
                Ok(())
            }
            Err(reason) => {
                one.lifecycle = ControllerLifecycle::Unconfigured;
                Err(SwitchRefused::one(format!("`{name}` cannot be configured: {reason}")))
            }
        }
    }

    /// Resets a controller that is not active to the unconfigured state.
    ///
    /// # Errors
    /// When there is no such controller or it is active.
    pub fn cleanup(&mut self, name: &str) -> Result<(), SwitchRefused> {
        let loaded = names(&self.controllers);
        let one = self.controllers.iter_mut().find(|one| one.name == name);
        let Some(one) = one else { return Err(SwitchRefused::one(unknown(name, &loaded))) };
        if one.lifecycle == ControllerLifecycle::Active {
            let reason = format!("`{name}` is active; deactivate it before it is cleaned up");
            return Err(SwitchRefused::one(reason));
        }
        one.lifecycle = ControllerLifecycle::Unconfigured;
        Ok(())
    }

    /// Removes a controller that is not active.
    ///
    /// # Errors
    /// When there is no such controller or it is active.
    pub fn unload(&mut self, name: &str) -> Result<(), SwitchRefused> {
        let Some(place) = self.controllers.iter().position(|one| one.name == name) else {
            return Err(SwitchRefused::one(unknown(name, &names(&self.controllers))));
        };
        if self.controllers[place].lifecycle == ControllerLifecycle::Active {
            let reason = format!("`{name}` is active; deactivate it before it is unloaded");
            return Err(SwitchRefused::one(reason));
        }
        self.controllers.remove(place);
        Ok(())
    }

    /// Deactivates and activates controllers. Problems that best effort skips are returned.
    ///
    /// # Errors
    /// With strict handling, when any controller cannot be switched; nothing is switched then. A
    /// controller that refuses its activation stays inactive, and the others are switched.
    pub fn switch(
        &mut self,
        request: &SwitchRequest,
        cycle: ControlCycle,
    ) -> Result<Vec<String>, SwitchRefused> {
        let mut problems = Vec::new();
        let mut ends = self.to_deactivate(&request.deactivate, &mut problems);
        let begins = self.to_activate(request, &mut ends, &mut problems);
        if request.strictness == SwitchStrictness::Strict && !problems.is_empty() {
            return Err(SwitchRefused { reasons: problems });
        }
        for place in ends {
            self.end(place);
        }
        for (place, commands, states) in begins {
            let one = &mut self.controllers[place];
            self.hardware.claim(&commands, &one.name);
            let mut interfaces = LoanedInterfaces::new(&mut self.hardware, &commands, &states);
            match one.controller.activate(&mut interfaces, cycle) {
                Ok(()) => {
                    one.lifecycle = ControllerLifecycle::Active;
                    (one.commands, one.states) = (commands, states);
                }
                Err(reason) => {
                    self.hardware.release(&commands);
                    problems.push(format!("`{}` cannot be activated: {reason}", one.name));
                }
            }
        }
        if request.strictness == SwitchStrictness::Strict && !problems.is_empty() {
            return Err(SwitchRefused { reasons: problems });
        }
        Ok(problems)
    }

    fn end(&mut self, place: usize) {
        let one = &mut self.controllers[place];
        let mut interfaces = LoanedInterfaces::new(&mut self.hardware, &one.commands, &one.states);
        one.controller.deactivate(&mut interfaces);
        one.lifecycle = ControllerLifecycle::Inactive;
        self.hardware.release(&one.commands);
        (one.commands, one.states) = Default::default();
    }

    fn to_deactivate(&self, names_given: &[String], problems: &mut Vec<String>) -> Vec<usize> {
        let mut ends = Vec::new();
        for name in names_given {
            match self.controllers.iter().position(|one| one.name == *name) {
                Some(place) if self.controllers[place].lifecycle == ControllerLifecycle::Active => {
                    if !ends.contains(&place) {
                        ends.push(place);
                    }
                }
                Some(place) => {
                    let label = self.controllers[place].lifecycle.label();
                    problems.push(format!("`{name}` cannot be deactivated: it is {label}"));
                }
                None => problems.push(unknown(name, &names(&self.controllers))),
            }
        }
        ends
    }

    /// Returns the controllers that can be activated, with the indices of their interfaces.
    fn to_activate(
        &self,
        request: &SwitchRequest,
        ends: &mut Vec<usize>,
        problems: &mut Vec<String>,
    ) -> Vec<(usize, Vec<usize>, Vec<usize>)> {
        let mut begins: Vec<(usize, Vec<usize>, Vec<usize>)> = Vec::new();
        for name in &request.activate {
            let Some(place) = self.controllers.iter().position(|one| one.name == *name) else {
                problems.push(unknown(name, &names(&self.controllers)));
                continue;
            };
            let one = &self.controllers[place];
            let restarts = ends.contains(&place);
            match one.lifecycle {
                ControllerLifecycle::Inactive => {}
                ControllerLifecycle::Active if restarts => {}
                ControllerLifecycle::Active => {
                    problems.push(format!("`{name}` cannot be activated: it is already active"));
                    continue;
                }
                ControllerLifecycle::Unconfigured => {
                    problems.push(format!("`{name}` cannot be activated: configure it first"));
                    continue;
                }
            }
            let places = self.places_of(&one.controller);
            let (commands, states) = match places {
                Ok(places) => places,
                Err(reason) => {
                    problems.push(format!("`{name}` cannot be activated: {reason}"));
                    continue;
                }
            };
            if let Some(reason) = self.conflict(&commands, request.strictness, ends, &begins) {
                problems.push(format!("`{name}` cannot be activated: {reason}"));
                continue;
            }
            begins.push((place, commands, states));
        }
        begins
    }

    /// Returns the reason for which command interfaces are not free.
    fn conflict(
        &self,
        commands: &[usize],
        strictness: SwitchStrictness,
        ends: &mut Vec<usize>,
        begins: &[(usize, Vec<usize>, Vec<usize>)],
    ) -> Option<String> {
        for &command in commands {
            let name = self.hardware.commands().nth(command).map_or("", |(name, _)| name);
            if let Some((other, ..)) = begins.iter().find(|(_, taken, _)| taken.contains(&command))
            {
                let other = &self.controllers[*other].name;
                return Some(format!("`{name}` is claimed by `{other}` in the same request"));
            }
            let holder = self.controllers.iter().position(|one| one.commands.contains(&command));
            match holder.filter(|holder| !ends.contains(holder)) {
                Some(holder) if strictness == SwitchStrictness::ForceAuto => ends.push(holder),
                Some(holder) => {
                    let other = &self.controllers[holder].name;
                    return Some(format!(
                        "`{name}` is claimed by the active controller `{other}`; deactivate it first"
                    ));
                }
                None => {}
            }
        }
        None
    }

    fn places_of(&self, controller: &C) -> Result<(Vec<usize>, Vec<usize>), String> {
        let commands = match controller.command_interfaces() {
            InterfaceSelection::Nothing => Vec::new(),
            InterfaceSelection::All => (0..self.hardware.commands().count()).collect(),
            InterfaceSelection::Named(names) => places(
                &names,
                |name| self.hardware.command_place(name),
                "command",
                || self.hardware.commands().map(|(name, _)| name.to_owned()).collect(),
            )?,
        };
        let states = match controller.state_interfaces() {
            InterfaceSelection::Nothing => Vec::new(),
            InterfaceSelection::All => (0..self.hardware.states().count()).collect(),
            InterfaceSelection::Named(names) => places(
                &names,
                |name| self.hardware.state_place(name),
                "state",
                || self.hardware.states().map(|(name, _)| name.to_owned()).collect(),
            )?,
        };
        Ok((commands, states))
    }

    /// Updates all active controllers in the order of loading. One that fails is deactivated.
    pub fn update(&mut self, cycle: ControlCycle) -> Vec<UpdateFailure> {
        let mut failures = Vec::new();
        for place in 0..self.controllers.len() {
            let one = &mut self.controllers[place];
            if one.lifecycle != ControllerLifecycle::Active {
                continue;
            }
            let mut interfaces =
                LoanedInterfaces::new(&mut self.hardware, &one.commands, &one.states);
            if let Err(reason) = one.controller.update(&mut interfaces, cycle) {
                let reason = reason.to_string();
                failures.push(UpdateFailure { controller: one.name.clone(), reason });
                self.end(place);
            }
        }
        failures
    }
}

fn names<C>(controllers: &[LoadedController<C>]) -> Vec<String> {
    controllers.iter().map(|one| one.name.clone()).collect()
}

fn unknown(name: &str, loaded: &[String]) -> String {
    if loaded.is_empty() {
        return format!("no controller `{name}` is loaded");
    }
    format!("no controller `{name}` is loaded; loaded controllers: {}", loaded.join(", "))
}

/// Returns the indices of named interfaces.
fn places(
    names: &[String],
    place: impl Fn(&str) -> Option<usize>,
    kind: &str,
    known: impl Fn() -> Vec<String>,
) -> Result<Vec<usize>, String> {
    let mut places = Vec::new();
    for name in names {
        match place(name) {
            Some(place) => places.push(place),
            None => {
                let known = known();
                let known = if known.is_empty() { "none".to_owned() } else { known.join(", ") };
                return Err(format!(
                    "the hardware has no {kind} interface `{name}`; it has: {known}"
                ));
            }
        }
    }
    Ok(places)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Commands 1 on all of its interfaces.
    struct Constant(&'static [&'static str]);

    impl ControllerInterface for Constant {
        fn command_interfaces(&self) -> InterfaceSelection {
            InterfaceSelection::Named(self.0.iter().map(|&name| name.to_owned()).collect())
        }

        fn state_interfaces(&self) -> InterfaceSelection {
            InterfaceSelection::All
        }

        fn activate(
            &mut self,
            _: &mut LoanedInterfaces<'_>,
            _: ControlCycle,
        ) -> Result<(), ControllerError> {
            Ok(())
        }

        fn update(
            &mut self,
            interfaces: &mut LoanedInterfaces<'_>,
            cycle: ControlCycle,
        ) -> Result<(), ControllerError> {
            if cycle.time_ns < 0 {
                return Err("before the start".into());
            }
            (0..interfaces.command_count()).for_each(|index| interfaces.set_command(index, 1.0));
            Ok(())
        }
    }

    const NOW: ControlCycle = ControlCycle { time_ns: 0, period_s: 0.01 };

    fn manager(controllers: &[(&str, &'static [&'static str])]) -> ControllerManager<Constant> {
        let mut hardware = Hardware::default();
        for joint in ["left", "right"] {
            hardware.add_command(format!("{joint}/velocity"));
            hardware.add_state(format!("{joint}/position"), 0.0);
        }
        let mut manager = ControllerManager::new(hardware);
        for (name, commands) in controllers {
            manager.load(*name, "Constant", Constant(commands)).unwrap();
            manager.configure(name).unwrap();
        }
        manager
    }

    fn switch(
        manager: &mut ControllerManager<Constant>,
        activate: &[&str],
        deactivate: &[&str],
        strictness: SwitchStrictness,
    ) -> Result<Vec<String>, String> {
        let owned = |names: &[&str]| names.iter().map(|&name| name.to_owned()).collect();
        let request =
            SwitchRequest { activate: owned(activate), deactivate: owned(deactivate), strictness };
        manager.switch(&request, NOW).map_err(|refused| refused.to_string())
    }

    #[test]
    fn a_claimed_interface_is_refused_with_its_reason() {
        let both: &[(&str, &'static [&'static str])] =
            &[("drive", &["left/velocity", "right/velocity"]), ("other", &["right/velocity"])];
        let mut manager = manager(both);
        switch(&mut manager, &["drive"], &[], SwitchStrictness::Strict).unwrap();
        assert_eq!(
            switch(&mut manager, &["other"], &[], SwitchStrictness::Strict).unwrap_err(),
            "`other` cannot be activated: `right/velocity` is claimed by the active controller \
             `drive`; deactivate it first"
        );
        let skipped = switch(&mut manager, &["other"], &[], SwitchStrictness::BestEffort).unwrap();
        assert_eq!(skipped.len(), 1);
        // In one request the one is replaced by the other.
        switch(&mut manager, &["other"], &["drive"], SwitchStrictness::Strict).unwrap();
        assert_eq!(manager.hardware.claimant("right/velocity"), Some("other"));
        assert_eq!(manager.hardware.claimant("left/velocity"), None);
        // Automatically too.
        switch(&mut manager, &["drive"], &[], SwitchStrictness::ForceAuto).unwrap();
        assert_eq!(manager.hardware.claimant("right/velocity"), Some("drive"));
    }

    #[test]
    fn only_active_controllers_command() {
        let mut manager = manager(&[("drive", &["left/velocity"])]);
        assert!(manager.update(NOW).is_empty());
        assert_eq!(manager.hardware.claimed_command("left/velocity"), None);
        switch(&mut manager, &["drive"], &[], SwitchStrictness::Strict).unwrap();
        assert!(manager.hardware.is_claimed("left/velocity"));
        assert_eq!(manager.hardware.claimed_command("left/velocity"), None);
        manager.update(NOW);
        assert_eq!(manager.hardware.claimed_command("left/velocity"), Some(1.0));
        let failed = manager.update(ControlCycle { time_ns: -1, ..NOW });
        assert_eq!(failed[0].reason, "before the start");
        assert!(!manager.hardware.is_claimed("left/velocity"));
        assert_eq!(manager.find("drive").unwrap().lifecycle, ControllerLifecycle::Inactive);
    }

    #[test]
    fn wrong_orders_are_refused() {
        let mut manager = manager(&[("drive", &["left/velocity"]), ("lost", &["middle/velocity"])]);
        let strict = SwitchStrictness::Strict;
        let missing = switch(&mut manager, &["lost"], &[], strict).unwrap_err();
        assert_eq!(
            missing,
            "`lost` cannot be activated: the hardware has no command interface \
             `middle/velocity`; it has: left/velocity, right/velocity"
        );
        let unknown = switch(&mut manager, &["dirve"], &[], strict).unwrap_err();
        assert_eq!(unknown, "no controller `dirve` is loaded; loaded controllers: drive, lost");
        assert!(switch(&mut manager, &[], &["drive"], strict).is_err());
        switch(&mut manager, &["drive"], &[], strict).unwrap();
        assert!(switch(&mut manager, &["drive"], &[], strict).is_err());
        assert!(manager.configure("drive").is_err() && manager.unload("drive").is_err());
        assert!(manager.load("drive", "Constant", Constant(&[])).is_err());
        switch(&mut manager, &[], &["drive"], strict).unwrap();
        manager.cleanup("drive").unwrap();
        assert!(switch(&mut manager, &["drive"], &[], strict).is_err());
        manager.unload("drive").unwrap();
        assert_eq!(manager.controllers().len(), 1);
    }
}
