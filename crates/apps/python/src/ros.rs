//! Nodes of users' programs: the core under `periplus.ros`.
//!
//! A [`graph::RosGraph`] is one program: live on the ROS 2 network, or in step with a simulation. Executors, timers,
//! parameters and everything else of a node is Python above it.

mod arguments;
mod arrivals;
mod backend;
mod discovery;
mod endpoints;
mod graph;
mod node;
mod qos;

use pyo3::prelude::*;

pub(crate) use graph::RosGraph;

pub(crate) fn register(module: &Bound<'_, PyModule>) -> PyResult<()> {
    module.add("RosArgumentsError", module.py().get_type::<arguments::RosArgumentsError>())?;
    module.add("RosNameError", module.py().get_type::<node::RosNameError>())?;
    module.add_class::<graph::RosGraph>()?;
    module.add_class::<node::RosNode>()?;
    module.add_class::<endpoints::RosPublisher>()?;
    module.add_class::<endpoints::RosSubscription>()?;
    module.add_class::<endpoints::RosClient>()?;
    module.add_class::<endpoints::RosServer>()?;
    module.add_class::<endpoints::RosCall>()?;
    module.add_function(wrap_pyfunction!(arguments::ros_split_arguments, module)?)
}
