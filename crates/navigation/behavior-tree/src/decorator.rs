//! Decorators of BehaviorTree.CPP.

mod repeat;
mod simple;
mod timing;
mod updated;

use crate::value::PortType;
use crate::{NodeKind, NodeModel, NodeRegistry, NodeStatus};

use repeat::{Repeat, Retry};
use simple::{BlackboardCheck, Map, Precondition, RunOnce};
pub(crate) use timing::MILLISECOND_NS;
use timing::{Delay, Timeout};
use updated::UnlessUpdated;

pub(crate) fn register(registry: &mut NodeRegistry) {
    use NodeStatus::{Failure, Running, Success};
    let decorator = |name: &str| NodeModel::new(name, NodeKind::Decorator);
    let int = PortType::int;
    registry.register(decorator("Inverter"), || Map { success: Failure, failure: Success });
    registry.register(decorator("ForceSuccess"), || Map { success: Success, failure: Success });
    registry.register(decorator("ForceFailure"), || Map { success: Failure, failure: Failure });
    registry.register(decorator("KeepRunningUntilFailure"), || Map {
        success: Running,
        failure: Failure,
    });
    let repeat = decorator("Repeat").input("num_cycles", int());
    registry.register(repeat, Repeat::default);
    // The second name is a slip of format 3 that files still have.
    for name in ["RetryUntilSuccessful", "RetryUntilSuccesful"] {
        let retry = decorator(name).input("num_attempts", int());
        registry.register(retry, Retry::default);
    }
    let timeout = decorator("Timeout").input("msec", int());
    registry.register(timeout, Timeout::default);
    let delay = decorator("Delay").input("delay_msec", int());
    registry.register(delay, Delay::default);
    let run_once = decorator("RunOnce").input_or("then_skip", PortType::Bool, "true");
    registry.register(run_once, RunOnce::default);
    let precondition = decorator("Precondition").input("if", PortType::Text).input_or(
        "else",
        PortType::Status,
        "FAILURE",
    );
    registry.register(precondition, Precondition::default);
    let entry = |name: &str| decorator(name).input("entry", PortType::Any);
    registry.register(entry("SkipUnlessUpdated"), || UnlessUpdated::new(NodeStatus::Skipped));
    registry.register(entry("WaitValueUpdate"), || UnlessUpdated::new(Running));
    for (name, port_type) in [
        ("BlackboardCheckInt", int()),
        ("BlackboardCheckDouble", PortType::real()),
        ("BlackboardCheckString", PortType::Text),
        ("BlackboardCheckBool", PortType::Bool),
    ] {
        let check = decorator(name)
            .input("value_A", port_type.clone())
            .input("value_B", port_type)
            .input_or("return_on_mismatch", PortType::Status, "FAILURE");
        registry.register(check, || BlackboardCheck);
    }
}
