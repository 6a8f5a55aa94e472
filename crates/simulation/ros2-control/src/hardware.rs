//! Command and state interfaces by name.

use std::collections::BTreeMap;

/// Kind of a joint's interface.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum JointInterfaceKind {
    /// Position [m or rad].
    Position,
    /// Velocity [m/s or rad/s].
    Velocity,
    /// Effort [N or N m].
    Effort,
}

impl JointInterfaceKind {
    /// All kinds.
    pub const ALL: [Self; 3] = [Self::Position, Self::Velocity, Self::Effort];

    /// Returns the name in ROS.
    #[must_use]
    pub fn name(self) -> &'static str {
        match self {
            Self::Position => "position",
            Self::Velocity => "velocity",
            Self::Effort => "effort",
        }
    }

    /// Returns the kind of a name.
    #[must_use]
    pub fn of_name(name: &str) -> Option<Self> {
        Self::ALL.into_iter().find(|kind| kind.name() == name)
    }

    /// Returns the interface of an owner: `joint/velocity`.
    #[must_use]
    pub fn of(self, owner: &str) -> String {
        format!("{owner}/{}", self.name())
    }
}

/// A command interface with its claim.
#[derive(Clone, Debug, PartialEq)]
struct CommandInterface {
    name: String,
    /// NaN without a command.
    value: f64,
    claimed_by: Option<String>,
}

/// A state interface.
#[derive(Clone, Debug, PartialEq)]
struct StateInterface {
    name: String,
    value: f64,
}

/// Interfaces of all hardware components, as the resource manager of ROS 2 keeps them.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Hardware {
    commands: Vec<CommandInterface>,
    states: Vec<StateInterface>,
    command_places: BTreeMap<String, usize>,
    state_places: BTreeMap<String, usize>,
}

impl Hardware {
    /// Adds a command interface without a command; a name that exists is not added twice.
    pub fn add_command(&mut self, name: impl Into<String>) {
        let name = name.into();
        if !self.command_places.contains_key(&name) {
            self.command_places.insert(name.clone(), self.commands.len());
            self.commands.push(CommandInterface { name, value: f64::NAN, claimed_by: None });
        }
    }

    /// Adds a state interface with a value; a name that exists is not added twice.
    pub fn add_state(&mut self, name: impl Into<String>, value: f64) {
        let name = name.into();
        if !self.state_places.contains_key(&name) {
            self.state_places.insert(name.clone(), self.states.len());
            self.states.push(StateInterface { name, value });
        }
    }

    /// Returns the names of the command interfaces with the controllers that claim them.
    pub fn commands(&self) -> impl Iterator<Item = (&str, Option<&str>)> {
        self.commands.iter().map(|command| (command.name.as_str(), command.claimed_by.as_deref()))
    }

    /// Returns the names of the state interfaces with their values.
    pub fn states(&self) -> impl Iterator<Item = (&str, f64)> {
        self.states.iter().map(|state| (state.name.as_str(), state.value))
    }

    /// Returns a state; `None` for an unknown name.
    #[must_use]
    pub fn state(&self, name: &str) -> Option<f64> {
        Some(self.states[*self.state_places.get(name)?].value)
    }

    /// Sets a state; an unknown name is ignored.
    pub fn set_state(&mut self, name: &str, value: f64) {
        if let Some(&place) = self.state_places.get(name) {
            self.states[place].value = value;
        }
    }

    /// Returns the command of an interface that a controller claims; `None` if none does or it has
    /// not commanded yet.
    #[must_use]
    pub fn claimed_command(&self, name: &str) -> Option<f64> {
        let command = &self.commands[*self.command_places.get(name)?];
        command.claimed_by.as_ref().map(|_| command.value).filter(|value| value.is_finite())
    }

    /// Returns true if a controller claims a command interface.
    #[must_use]
    pub fn is_claimed(&self, name: &str) -> bool {
        self.claimant(name).is_some()
    }

    /// Returns the controller that claims a command interface.
    #[must_use]
    pub fn claimant(&self, name: &str) -> Option<&str> {
        self.commands[*self.command_places.get(name)?].claimed_by.as_deref()
    }

    pub(crate) fn command_place(&self, name: &str) -> Option<usize> {
        self.command_places.get(name).copied()
    }

    pub(crate) fn state_place(&self, name: &str) -> Option<usize> {
        self.state_places.get(name).copied()
    }

    pub(crate) fn claim(&mut self, places: &[usize], controller: &str) {
        for &place in places {
            let command = &mut self.commands[place];
            (command.claimed_by, command.value) = (Some(controller.to_owned()), f64::NAN);
        }
    }

    pub(crate) fn release(&mut self, places: &[usize]) {
        for &place in places {
            let command = &mut self.commands[place];
            (command.claimed_by, command.value) = (None, f64::NAN);
        }
    }
}

/// The interfaces that a controller uses, in the order in which it named them.
#[derive(Debug)]
pub struct LoanedInterfaces<'a> {
    hardware: &'a mut Hardware,
    commands: &'a [usize],
    states: &'a [usize],
}

impl<'a> LoanedInterfaces<'a> {
    pub(crate) fn new(
        hardware: &'a mut Hardware,
        commands: &'a [usize],
        states: &'a [usize],
    ) -> Self {
        Self { hardware, commands, states }
    }

    /// Returns the number of state interfaces.
    #[must_use]
    pub fn state_count(&self) -> usize {
        self.states.len()
    }

    /// Returns the number of command interfaces.
    #[must_use]
    pub fn command_count(&self) -> usize {
        self.commands.len()
    }

    /// Returns a state by its position in the controller's list; NaN beyond its end.
    #[must_use]
    pub fn state(&self, index: usize) -> f64 {
        self.states.get(index).map_or(f64::NAN, |&place| self.hardware.states[place].value)
    }

    /// Returns the name of a state interface; empty beyond the end of the list.
    #[must_use]
    pub fn state_name(&self, index: usize) -> &str {
        self.states.get(index).map_or("", |&place| self.hardware.states[place].name.as_str())
    }

    /// Returns a command by its position in the controller's list; NaN beyond its end or without
    /// a command.
    #[must_use]
    pub fn command(&self, index: usize) -> f64 {
        self.commands.get(index).map_or(f64::NAN, |&place| self.hardware.commands[place].value)
    }

    /// Sets a command by its position in the controller's list; nothing happens beyond its end.
    pub fn set_command(&mut self, index: usize, value: f64) {
        if let Some(&place) = self.commands.get(index) {
            self.hardware.commands[place].value = value;
        }
    }
}
