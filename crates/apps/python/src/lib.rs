//! The native module of the Python package `periplus`.
//!
//! One module for each part of the package. Python calls the crates; nothing is implemented a second time. Calls
//! that take long release the interpreter and answer Ctrl-C; errors are exceptions with a file, line and column
//! where there is one.

mod amcl;
mod arrays;
mod background;
mod bags;
mod command;
mod costmap;
mod ekf;
mod environments;
mod errors;
mod estimator_parameters;
mod exploration;
mod laser_scanner;
mod maps;
mod messages;
mod navigation;
mod poses;
mod rays;
mod robot_files;
mod ros;
mod scan_matching;
mod scenarios;
mod simulation;
mod slam;
mod transforms;
mod work;

use pyo3::prelude::*;

/// The native module.
#[pymodule(gil_used = false)]
fn _native(module: &Bound<'_, PyModule>) -> PyResult<()> {
    module.add("__version__", env!("CARGO_PKG_VERSION"))?;
    for register in [
        errors::register,
        command::register,
        poses::register,
        rays::register,
        maps::register,
        scan_matching::register,
        costmap::register,
        exploration::register,
        transforms::register,
        ekf::register,
        environments::register,
        laser_scanner::register,
        slam::register,
        amcl::register,
        messages::register,
        bags::register,
        robot_files::register,
        ros::register,
        simulation::register,
        navigation::register,
        scenarios::register,
    ] {
        register(module)?;
    }
    // The names for users are those of the package, not of this module.
    module.delattr("__all__")
}
