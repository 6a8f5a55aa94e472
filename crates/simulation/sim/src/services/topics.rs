//! State topics: those of plugins always, others while they have subscribers.

use periplus_graph::{Graph, GraphError, Node, Publisher, Qos};
use periplus_msgs::Message;
use periplus_msgs::gazebo_msgs::{LinkStates, ModelStates};

use super::convert::{pose_message, twist_message};
use super::entity::{Entity, motion_of};
use super::state_plugin::StatePlugin;
use crate::Simulation;

/// Default publishing period \[ns\], that of `gazebo_ros_state`.
const DEFAULT_PERIOD_NS: i64 = 10_000_000;

/// Period of checks for subscribers \[ns\].
const CHECK_PERIOD_NS: i64 = 100_000_000;

/// A topic that exists while it has subscribers. Taps do not count: a bag of all topics must not
/// contain unrequested ones.
pub(super) struct OnDemand<T> {
    name: String,
    publisher: Option<Publisher<T>>,
    /// True if it exists without subscribers too.
    is_kept: bool,
}

impl<T: Message> OnDemand<T> {
    pub(super) fn new(name: impl Into<String>) -> Self {
        Self { name: name.into(), publisher: None, is_kept: false }
    }

    /// Advertises the topic permanently, with or without subscribers.
    pub(super) fn keep(&mut self, node: &Node) -> Result<(), GraphError> {
        self.is_kept = true;
        self.set(node, true)
    }

    /// Creates the publisher if the topic has subscriptions, and removes it otherwise.
    pub(super) fn look(&mut self, node: &Node, graph: &Graph) -> Result<(), GraphError> {
        self.set(node, graph.is_subscribed(&self.name))
    }

    fn set(&mut self, node: &Node, is_wanted: bool) -> Result<(), GraphError> {
        match (&self.publisher, is_wanted) {
            (None, true) => self.publisher = Some(node.publisher(&self.name, Qos::reliable(1))?),
            (Some(_), false) if !self.is_kept => self.publisher = None,
            _ => {}
        }
        Ok(())
    }

    /// Returns the publisher, if it has subscribers.
    pub(super) fn heard(&self) -> Option<&Publisher<T>> {
        self.publisher.as_ref().filter(|publisher| publisher.is_heard())
    }
}

/// Periodic timer in simulated time.
#[derive(Clone, Copy, Debug)]
pub(super) struct PeriodTimer {
    period_ns: i64,
    next_ns: i64,
    last_ns: i64,
}

impl PeriodTimer {
    /// The first time is after one period.
    pub(super) fn new(period_ns: i64, now_ns: i64) -> Self {
        Self { period_ns, next_ns: now_ns.saturating_add(period_ns), last_ns: now_ns }
    }

    /// Returns true if the timer is due. A jump back in time restarts it. It is due at most once per
    /// time.
    pub(super) fn is_due(&mut self, now_ns: i64) -> bool {
        if now_ns < self.last_ns {
            *self = Self::new(self.period_ns, now_ns);
        }
        if now_ns < self.next_ns || now_ns == self.last_ns {
            return false;
        }
        self.last_ns = now_ns;
        let late_ns = now_ns - self.next_ns;
        let periods = late_ns.checked_div(self.period_ns).unwrap_or_default() + 1;
        self.next_ns += periods * self.period_ns;
        true
    }
}

/// `model_states` and `link_states` with a common prefix.
struct Pair {
    beat: PeriodTimer,
    models: Outlet<ModelStates>,
    links: Outlet<LinkStates>,
}

enum Outlet<T> {
    Always(Publisher<T>),
    OnDemand(OnDemand<T>),
}

impl<T: Message> Outlet<T> {
    fn heard(&self) -> Option<&Publisher<T>> {
        match self {
            Self::Always(publisher) => Some(publisher).filter(|publisher| publisher.is_heard()),
            Self::OnDemand(on_demand) => on_demand.heard(),
        }
    }

    fn look(&mut self, node: &Node, graph: &Graph) -> Result<(), GraphError> {
        match self {
            Self::Always(_) => Ok(()),
            Self::OnDemand(on_demand) => on_demand.look(node, graph),
        }
    }
}

/// Publishes the states of models and links.
pub(super) struct StateTopics {
    node: Node,
    look: PeriodTimer,
    pairs: Vec<Pair>,
}

impl StateTopics {
    pub(super) fn new(
        node: &Node,
        plugins: &[StatePlugin],
        now_ns: i64,
    ) -> Result<Self, GraphError> {
        let mut pairs = Vec::new();
        let mut taken = Vec::new();
        for plugin in plugins {
            let (models, links) = (plugin.resolve("model_states"), plugin.resolve("link_states"));
            pairs.push(Pair {
                beat: PeriodTimer::new(plugin.period_ns(), now_ns),
                models: Outlet::Always(node.publisher(&models, Qos::reliable(1))?),
                links: Outlet::Always(node.publisher(&links, Qos::reliable(1))?),
            });
            taken.extend([models, links]);
        }
        for space in ["", "/gazebo"] {
            let (models, links) = (format!("{space}/model_states"), format!("{space}/link_states"));
            if !(taken.contains(&models) || taken.contains(&links)) {
                pairs.push(Pair {
                    beat: PeriodTimer::new(DEFAULT_PERIOD_NS, now_ns),
                    models: Outlet::OnDemand(OnDemand::new(models)),
                    links: Outlet::OnDemand(OnDemand::new(links)),
                });
            }
        }
        // The first check is immediate.
        let look = PeriodTimer::new(CHECK_PERIOD_NS, now_ns.saturating_sub(CHECK_PERIOD_NS));
        Ok(Self { node: node.clone(), look, pairs })
    }

    /// Returns its timers.
    pub(super) fn save(&self) -> Vec<PeriodTimer> {
        std::iter::once(self.look).chain(self.pairs.iter().map(|pair| pair.beat)).collect()
    }

    /// Restores its timers.
    pub(super) fn restore(&mut self, saved: &[PeriodTimer]) {
        let own = std::iter::once(&mut self.look);
        let own = own.chain(self.pairs.iter_mut().map(|pair| &mut pair.beat));
        own.zip(saved).for_each(|(own, saved)| *own = *saved);
    }

    /// Publishes due states.
    ///
    /// # Errors
    /// When a topic of this name has another type.
    pub(super) fn publish(&mut self, simulation: &Simulation) -> Result<(), GraphError> {
        let now_ns = simulation.time_ns();
        if self.look.is_due(now_ns) {
            let graph = simulation.graph();
            for pair in &mut self.pairs {
                pair.models.look(&self.node, graph)?;
                pair.links.look(&self.node, graph)?;
            }
        }
        for pair in &mut self.pairs {
            if !pair.beat.is_due(now_ns) {
                continue;
            }
            if let Some(publisher) = pair.models.heard() {
                publisher.publish(model_states(simulation));
            }
            if let Some(publisher) = pair.links.heard() {
                publisher.publish(link_states(simulation));
            }
        }
        Ok(())
    }
}

fn model_states(simulation: &Simulation) -> ModelStates {
    let motion = simulation.motion();
    let mut states = ModelStates::default();
    for (model, name) in motion.models() {
        let Some(found) = motion_of(motion, Entity::Model(model)) else { continue };
        states.name.push(name.to_owned());
        states.pose.push(pose_message(found.pose));
        states.twist.push(twist_message(found.linear_m_s, found.angular_rad_s));
    }
    states
}

fn link_states(simulation: &Simulation) -> LinkStates {
    let motion = simulation.motion();
    let mut states = LinkStates::default();
    for (model, name) in motion.models() {
        for link in motion.links(model) {
            let (Some(state), Some(link)) = (motion.link_state(link), motion.link_name(link))
            else {
                continue;
            };
            states.name.push(format!("{name}::{link}"));
            states.pose.push(pose_message(state.world_from_link));
            states.twist.push(twist_message(state.linear_m_s, state.angular_rad_s));
        }
    }
    states
}

#[cfg(test)]
mod tests {
    use super::PeriodTimer;

    #[test]
    fn a_beat_keeps_its_time_and_begins_anew_after_a_jump_back() {
        let mut beat = PeriodTimer::new(10, 0);
        let due = [0, 5, 10, 10, 19, 20, 47, 50, 3, 12, 13].map(|now_ns| beat.is_due(now_ns));
        let wanted = [false, false, true, false, false, true, true, true, false, false, true];
        assert_eq!(due, wanted);
    }

    #[test]
    fn without_a_period_each_step_is_one() {
        let mut beat = PeriodTimer::new(0, 0);
        assert_eq!([0, 1, 1, 2].map(|now_ns| beat.is_due(now_ns)), [false, true, false, true]);
    }
}
