//! Lifecycle node of the behavior server.

use periplus_geometry::Twist2;
use periplus_graph::{
    ActionSettings, Actor, Graph, GraphError, Io, Level, LifecycleCallbacks, LifecycleNode, Node,
    NodeSettings, Qos, StepOutcome,
};
use periplus_motion::tables::BehaviorServerParams;
use periplus_msgs::std_msgs::Empty;
use periplus_params::ParamValues;

use crate::simple_action_server::serve_simple_action;
use crate::velocity_topics::{components, subscribe_velocity};

use super::behavior::{Behavior, Slot, begin};
use super::config::{BehaviorKind, BehaviorServerConfig};
use super::motions::{BackUpBehavior, DriveOnHeadingBehavior, SpinBehavior};
use super::others::{AssistedTeleopBehavior, WaitBehavior};
use super::plugin::{BehaviorAction, PluginBehavior, PluginSlots, RegisteredBehavior};
use super::world::BehaviorWorld;

/// Behaviors of all kinds.
#[derive(Default)]
pub(super) struct Slots {
    pub(super) spins: Vec<Slot<SpinBehavior>>,
    pub(super) backups: Vec<Slot<BackUpBehavior>>,
    pub(super) drives: Vec<Slot<DriveOnHeadingBehavior>>,
    pub(super) teleops: Vec<Slot<AssistedTeleopBehavior>>,
    pub(super) waits: Vec<Slot<WaitBehavior>>,
    /// Behaviors of other authors.
    pub(super) plugins: PluginSlots,
}

impl Slots {
    fn activate(&mut self) {
        self.spins.iter_mut().for_each(|slot| slot.server.activate());
        self.backups.iter_mut().for_each(|slot| slot.server.activate());
        self.drives.iter_mut().for_each(|slot| slot.server.activate());
        self.teleops.iter_mut().for_each(|slot| slot.server.activate());
        self.waits.iter_mut().for_each(|slot| slot.server.activate());
        self.plugins.spins.iter_mut().for_each(|slot| slot.server.activate());
        self.plugins.backups.iter_mut().for_each(|slot| slot.server.activate());
        self.plugins.drives.iter_mut().for_each(|slot| slot.server.activate());
        self.plugins.waits.iter_mut().for_each(|slot| slot.server.activate());
    }

    /// Ends all goals. Returns true if the robot has to be stopped.
    fn deactivate(&mut self, world: &mut BehaviorWorld) -> bool {
        fn all<B: Behavior>(slots: &mut [Slot<B>], world: &mut BehaviorWorld) -> bool {
            slots.iter_mut().fold(false, |moves, slot| slot.deactivate(world) | moves)
        }
        let moving = [
            all(&mut self.spins, world),
            all(&mut self.backups, world),
            all(&mut self.drives, world),
            all(&mut self.teleops, world),
            all(&mut self.waits, world),
            all(&mut self.plugins.spins, world),
            all(&mut self.plugins.backups, world),
            all(&mut self.plugins.drives, world),
            all(&mut self.plugins.waits, world),
        ];
        moving.contains(&true)
    }
}

/// Behavior server as a lifecycle node.
pub struct BehaviorServerNode {
    config: BehaviorServerConfig,
    pub(super) slots: Slots,
    pub(super) world: BehaviorWorld,
}

impl BehaviorServerNode {
    /// Creates a node `behavior_server`.
    ///
    /// # Errors
    /// When a topic or action of that name has another type.
    pub fn new(
        graph: &Graph,
        config: BehaviorServerConfig,
    ) -> Result<LifecycleNode<Self>, GraphError> {
        Self::at(graph.node(NodeSettings::new("behavior_server"))?, config)
    }

    /// Runs the behavior server as a node of the graph.
    ///
    /// # Errors
    /// When a topic or action of that name has another type.
    pub fn at(node: Node, config: BehaviorServerConfig) -> Result<LifecycleNode<Self>, GraphError> {
        Self::with_plugins(node, config, Vec::new())
    }

    /// Runs the behavior server as [`Self::at`] does, with behaviors of other authors.
    ///
    /// # Errors
    /// When a topic or action of that name has another type.
    pub fn with_plugins(
        node: Node,
        config: BehaviorServerConfig,
        registered: Vec<RegisteredBehavior>,
    ) -> Result<LifecycleNode<Self>, GraphError> {
        let values = config.values();
        let world = BehaviorWorld::new(&node, config.params())?;
        let mut actor = node.actor(Self { config, slots: Slots::default(), world });
        let parameters = actor.parameters(values, |state, values, _| {
            state.adopt(values);
            Ok(())
        })?;
        let given = parameters.values();
        actor.with(|state| state.adopt(&given));
        let (behaviors, params, is_stamped) = actor.with(|state| {
            let is_stamped = state.world.uses_stamped_velocity();
            (state.config.behaviors.clone(), state.world.params.clone(), is_stamped)
        });
        for behavior in &behaviors {
            let (name, limits) = (&behavior.name, behavior.drive_limits(params.node.compat));
            match behavior.kind {
                BehaviorKind::Spin => serve(&mut actor, name, SpinBehavior::default(), &params)?,
                BehaviorKind::BackUp => {
                    serve(&mut actor, name, BackUpBehavior::new(limits), &params)?;
                }
                BehaviorKind::DriveOnHeading => {
                    serve(&mut actor, name, DriveOnHeadingBehavior::new(limits), &params)?;
                }
                BehaviorKind::AssistedTeleop => {
                    serve(&mut actor, name, AssistedTeleopBehavior::default(), &params)?;
                }
                BehaviorKind::Wait => serve(&mut actor, name, WaitBehavior::default(), &params)?,
            }
        }
        for RegisteredBehavior { name, action, plugin } in registered {
            let actor = &mut actor;
            match action {
                BehaviorAction::Spin => {
                    serve(actor, &name, PluginBehavior::<SpinBehavior>::new(plugin), &params)?;
                }
                BehaviorAction::BackUp => {
                    serve(actor, &name, PluginBehavior::<BackUpBehavior>::new(plugin), &params)?;
                }
                BehaviorAction::DriveOnHeading => {
                    let behavior = PluginBehavior::<DriveOnHeadingBehavior>::new(plugin);
                    serve(actor, &name, behavior, &params)?;
                }
                BehaviorAction::Wait => {
                    serve(actor, &name, PluginBehavior::<WaitBehavior>::new(plugin), &params)?;
                }
            }
        }
        if behaviors.iter().any(|it| it.kind == BehaviorKind::AssistedTeleop) {
            subscribe_velocity(
                &mut actor,
                &params.cmd_vel_teleop,
                is_stamped,
                |state, velocity, _| {
                    let [vx, vy, _, _, _, wz] = components(&velocity.twist);
                    let command = Twist2::new(vx, vy, wz);
                    if command.is_finite() {
                        state.world.teleop.command = command;
                    }
                },
            )?;
            actor.subscribe::<Empty>("preempt_teleop", Qos::reliable(10), |state, _, _| {
                state.world.teleop.is_preempted = true;
            })?;
        }
        actor.on_jump(|state, io| state.jump(io));
        LifecycleNode::new(actor)
    }

    /// Copies parameters into the configuration.
    fn adopt(&mut self, values: &ParamValues) {
        self.config.adopt(values);
        self.world.params = self.config.params();
    }

    /// Ends all goals and stops the robot.
    fn stop(&mut self, io: &Io<'_, Self>) {
        if self.slots.deactivate(&mut self.world) {
            self.world.drive(Twist2::ZERO, io.now_ns());
        }
    }

    fn jump(&mut self, io: &Io<'_, Self>) {
        self.stop(io);
        self.world.forget();
        if io.node().is_active() {
            self.slots.activate();
        }
        io.node().log(Level::Warn, "the clock jumped: running behaviors are aborted");
    }
}

/// Serves the action of a behavior.
fn serve<B: Behavior>(
    actor: &mut Actor<BehaviorServerNode>,
    name: &str,
    behavior: B,
    params: &BehaviorServerParams,
) -> Result<(), GraphError> {
    let index = actor.with(|state| {
        let slots = B::slots(&mut state.slots);
        slots.push(Slot::new(name, behavior));
        slots.len() - 1
    });
    let result_timeout_ns = (params.action_server_result_timeout_s * 1e9) as i64;
    serve_simple_action::<B::Action, BehaviorServerNode>(
        actor,
        params.node.compat,
        name,
        ActionSettings { result_timeout_ns },
        move |state| B::slots(&mut state.slots).get_mut(index).map(|slot| &mut slot.server),
        |_, _, _| Ok(()),
        move |state, io| begin::<B>(state, index, io),
    )
}

impl LifecycleCallbacks for BehaviorServerNode {
    fn on_configure(&mut self, io: &mut Io<'_, Self>) -> StepOutcome {
        match self.world.open(io.node()) {
            Ok(()) => StepOutcome::Success,
            Err(error) => {
                io.node().log(Level::Error, error);
                StepOutcome::Failure
            }
        }
    }

    fn on_activate(&mut self, _: &mut Io<'_, Self>) -> StepOutcome {
        self.slots.activate();
        StepOutcome::Success
    }

    fn on_deactivate(&mut self, io: &mut Io<'_, Self>) -> StepOutcome {
        self.stop(io);
        StepOutcome::Success
    }

    fn on_cleanup(&mut self, io: &mut Io<'_, Self>) -> StepOutcome {
        self.stop(io);
        self.world.close();
        StepOutcome::Success
    }
}
