//! Action servers.

use std::marker::PhantomData;
use std::sync::Arc;

use periplus_costmap::Nav2Release;
use periplus_graph::{
    ActionSettings, Actor, GoalHandle, GoalId, GoalState, GraphError, Io, NewGoal,
};
use periplus_msgs::{Action, Nav2Action, Nav2Service, ReleaseForm};

use super::{WithForm, with_form};

/// New goal of a Nav2 action. Dropping it rejects it.
#[must_use = "dropping a new goal rejects it"]
pub struct NewNav2Goal<A: Action> {
    inner: Box<dyn New<A>>,
    goal: Arc<A::Goal>,
}

/// Goal of a Nav2 action that is being executed. Dropping it before its end marks it as canceled.
pub struct Nav2GoalHandle<A: Action> {
    inner: Box<dyn Handle<A>>,
    goal: Arc<A::Goal>,
}

impl<A: Action> NewNav2Goal<A> {
    fn new<F: ReleaseForm<A>>(new: NewGoal<F>) -> Self {
        let goal = Arc::new(F::full_goal((**new.goal()).clone()));
        Self { inner: Box::new(new), goal }
    }

    /// The goal message.
    #[must_use]
    pub fn goal(&self) -> &Arc<A::Goal> {
        &self.goal
    }

    /// Id of the goal.
    #[must_use]
    pub fn id(&self) -> GoalId {
        self.inner.id()
    }

    /// Rejects the goal.
    pub fn reject(self) {}

    /// Accepts the goal; see [`NewGoal::accept`].
    #[must_use = "dropping the handle cancels the goal"]
    pub fn accept(self) -> Option<Nav2GoalHandle<A>> {
        let Self { inner, goal } = self;
        Some(Nav2GoalHandle { inner: inner.accept()?, goal })
    }
}

impl<A: Action> Nav2GoalHandle<A> {
    /// The goal message.
    #[must_use]
    pub fn goal(&self) -> &Arc<A::Goal> {
        &self.goal
    }

    /// Id of the goal.
    #[must_use]
    pub fn id(&self) -> GoalId {
        self.inner.id()
    }

    /// State of the goal.
    #[must_use]
    pub fn state(&self) -> GoalState {
        self.inner.state()
    }

    /// True if cancellation was requested.
    #[must_use]
    pub fn is_canceling(&self) -> bool {
        self.state() == GoalState::Canceling
    }

    /// Starts execution. False if it has started already or is being canceled.
    pub fn execute(&self) -> bool {
        self.inner.execute()
    }

    /// Publishes feedback.
    pub fn feedback(&self, feedback: A::Feedback) {
        self.inner.feedback(feedback);
    }

    /// Ends the goal with success. False without effect if it never started or is over.
    pub fn succeed(&self, result: A::Result) -> bool {
        self.inner.succeed(result)
    }

    /// Ends the goal as failed. False as for [`Nav2GoalHandle::succeed`].
    pub fn abort(&self, result: A::Result) -> bool {
        self.inner.abort(result)
    }

    /// Ends the goal as canceled. False if no cancellation was requested.
    pub fn canceled(&self, result: A::Result) -> bool {
        self.inner.canceled(result)
    }
}

/// Creates an action server with the form of a release. `on_goal` gets each new goal and accepts or
/// drops it; `on_cancel` decides if a goal may be canceled.
///
/// # Errors
/// As [`Actor::serve_action`].
pub fn serve_nav2_action<A: Nav2Action, S: Send + 'static>(
    actor: &mut Actor<S>,
    release: Nav2Release,
    name: &str,
    settings: ActionSettings,
    on_goal: impl FnMut(&mut S, NewNav2Goal<A>, &mut Io<'_, S>) + Send + 'static,
    on_cancel: impl FnMut(&mut S, GoalId, &mut Io<'_, S>) -> bool + Send + 'static,
) -> Result<(), GraphError> {
    let serve = Serve { actor, name, settings, on_goal, on_cancel, action: PhantomData };
    with_form::<A, _>(release, serve)
}

struct Serve<'a, A, S: Send + 'static, G, C> {
    actor: &'a mut Actor<S>,
    name: &'a str,
    settings: ActionSettings,
    on_goal: G,
    on_cancel: C,
    action: PhantomData<fn(A)>,
}

impl<A, S, G, C> WithForm<A> for Serve<'_, A, S, G, C>
where
    A: Nav2Action,
    S: Send + 'static,
    G: FnMut(&mut S, NewNav2Goal<A>, &mut Io<'_, S>) + Send + 'static,
    C: FnMut(&mut S, GoalId, &mut Io<'_, S>) -> bool + Send + 'static,
{
    type Output = Result<(), GraphError>;

    fn with<F: ReleaseForm<A>>(self) -> Self::Output {
        let mut on_goal = self.on_goal;
        let on_goal = move |state: &mut S, new: NewGoal<F>, io: &mut Io<'_, S>| {
            on_goal(state, NewNav2Goal::new(new), io);
        };
        self.actor.serve_action::<F>(self.name, self.settings, on_goal, self.on_cancel)
    }
}

/// A new goal of any form.
trait New<A: Action>: Send {
    fn id(&self) -> GoalId;
    fn accept(self: Box<Self>) -> Option<Box<dyn Handle<A>>>;
}

impl<A: Action, F: ReleaseForm<A>> New<A> for NewGoal<F> {
    fn id(&self) -> GoalId {
        NewGoal::id(self)
    }

    fn accept(self: Box<Self>) -> Option<Box<dyn Handle<A>>> {
        NewGoal::accept(*self).map(|handle| Box::new(handle) as Box<dyn Handle<A>>)
    }
}

/// A running goal of any form.
trait Handle<A: Action>: Send {
    fn id(&self) -> GoalId;
    fn state(&self) -> GoalState;
    fn execute(&self) -> bool;
    fn feedback(&self, feedback: A::Feedback);
    fn succeed(&self, result: A::Result) -> bool;
    fn abort(&self, result: A::Result) -> bool;
    fn canceled(&self, result: A::Result) -> bool;
}

impl<A: Action, F: ReleaseForm<A>> Handle<A> for GoalHandle<F> {
    fn id(&self) -> GoalId {
        GoalHandle::id(self)
    }

    fn state(&self) -> GoalState {
        GoalHandle::state(self)
    }

    fn execute(&self) -> bool {
        GoalHandle::execute(self)
    }

    fn feedback(&self, feedback: A::Feedback) {
        GoalHandle::feedback(self, F::feedback_of_full(feedback));
    }

    fn succeed(&self, result: A::Result) -> bool {
        GoalHandle::succeed(self, F::result_of_full(result))
    }

    fn abort(&self, result: A::Result) -> bool {
        GoalHandle::abort(self, F::result_of_full(result))
    }

    fn canceled(&self, result: A::Result) -> bool {
        GoalHandle::canceled(self, F::result_of_full(result))
    }
}

/// Serves a service of Nav2 in the form of a release. `react` gets the request in the form of main.
///
/// # Errors
/// As [`Actor::serve`].
pub fn serve_nav2_service<V: Nav2Service, S: Send + 'static>(
    actor: &mut Actor<S>,
    release: Nav2Release,
    name: &str,
    mut react: impl FnMut(&mut S, V::Request, &mut Io<'_, S>) -> V::Response + Send + 'static,
) -> Result<(), GraphError> {
    if release == Nav2Release::Main {
        return actor
            .serve::<V>(name, move |state, request, io| react(state, (*request).clone(), io));
    }
    actor.serve::<V::Jazzy>(name, move |state, request, io| {
        V::response_of_full(react(state, V::full_request((*request).clone()), io))
    })
}
