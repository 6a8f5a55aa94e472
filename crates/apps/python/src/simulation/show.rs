//! A simulation on the page and in pictures.

use std::net::{IpAddr, SocketAddr};

use numpy::PyArrayDyn;
use periplus::geometry::{Pose, Rpy};
use periplus::images::{Layout, pack_png};
use periplus::rendering::Lens;
use periplus_session::page::browser;
use periplus_session::{PageContext, PageSettings};
use pyo3::exceptions::PyValueError;
use pyo3::prelude::*;
use pyo3::types::PyBytes;

use super::PySimulation;
use crate::arrays::moved;
use crate::errors::{runtime_error, value_error};
use crate::poses::pose_argument;
use crate::work::released;

/// Horizontal field of view of pictures \[rad\].
const FIELD_OF_VIEW_RAD: f64 = 1.1;
/// Rays along each side of a pixel of a picture in a notebook, for smooth edges.
const RAYS_PER_SIDE: u32 = 2;
/// Camera of the usual picture: this far behind the robot, above the floor \[m\], and looking down \[rad\].
const BEHIND_M: f64 = 4.0;
const ABOVE_M: f64 = 3.0;
const DOWN_RAD: f64 = 0.6;
/// Size of a picture in a notebook \[px\].
const NOTEBOOK_SIZE_PX: (u32, u32) = (640, 400);

#[pymethods]
impl PySimulation {
    /// Open the page with the world, its topics and panels, and return its URL. It lives as long as the simulation
    /// and shows what ``step`` and ``run`` do; use ``run(..., real_time_factor=1.0)`` to watch.
    ///
    /// Parameters
    /// ----------
    /// open_browser : bool
    ///     True to open a browser.
    /// port : int
    ///     Port on this machine; default: 8765, or any free one if it is in use.
    ///
    /// Raises ``RuntimeError`` if the port cannot be used.
    #[pyo3(signature = (*, open_browser=true, port=8765))]
    fn view(&self, py: Python<'_>, open_browser: bool, port: u16) -> PyResult<String> {
        let opened = self.with(py, |running| {
            let context = PageContext {
                resource_path: running.search.folders.clone(),
                ..PageContext::default()
            };
            let address = SocketAddr::new(IpAddr::from([127, 0, 0, 1]), port);
            let settings =
                PageSettings { is_quiet: true, ..PageSettings::at(address, None, context) };
            running.session.open_page(&settings).map_err(|error| error.to_string())
        })?;
        let url = opened.map_err(runtime_error)?;
        if open_browser {
            // Without a browser the URL is still returned.
            let _ = browser::open(&url);
        }
        Ok(url)
    }

    /// Close the page.
    fn close_view(&self, py: Python<'_>) -> PyResult<()> {
        self.with(py, |running| running.session.close_page())
    }

    /// Render the world as a camera at a pose sees it that looks along its x axis.
    ///
    /// Parameters
    /// ----------
    /// pose : Pose or tuple, optional
    ///     Pose of the camera in the world; default: above and behind the first robot.
    /// width, height : int
    ///     Size [px].
    /// field_of_view_rad : float
    ///     Horizontal field of view [rad].
    ///
    /// Returns an array of shape (height, width, 3), uint8, red, green, blue.
    ///
    /// >>> from periplus import Simulation, World
    /// >>> Simulation(World.demo()).picture(width=32, height=24).shape
    /// (24, 32, 3)
    #[pyo3(signature = (pose=None, *, width=640, height=400, field_of_view_rad=1.1))]
    fn picture<'py>(
        &self,
        py: Python<'py>,
        pose: Option<&Bound<'_, PyAny>>,
        width: u32,
        height: u32,
        field_of_view_rad: f64,
    ) -> PyResult<Bound<'py, PyArrayDyn<u8>>> {
        let pose = pose.map(|pose| pose_argument(pose, "pose")).transpose()?;
        let lens = Lens::pinhole(width, height, field_of_view_rad).map_err(value_error)?;
        let rgb = self.with(py, |running| {
            let simulation = running.session.simulation_mut();
            let pose = pose.unwrap_or_else(|| usual_pose(simulation.robot_pose()));
            simulation.picture(&lens, pose).rgb
        })?;
        moved(py, rgb, &[height as usize, width as usize, 3])
    }

    fn _repr_png_<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyBytes>> {
        let (width, height) = NOTEBOOK_SIZE_PX;
        let (wide, high) = (width * RAYS_PER_SIDE, height * RAYS_PER_SIDE);
        let lens = Lens::pinhole(wide, high, FIELD_OF_VIEW_RAD).map_err(value_error)?;
        let rgb = self.with(py, |running| {
            let simulation = running.session.simulation_mut();
            let pose = usual_pose(simulation.robot_pose());
            simulation.picture(&lens, pose).rgb
        })?;
        let png = released(py, "encoding a picture", move || {
            let mean = smaller(&rgb, wide as usize);
            pack_png(width, height, Layout::Rgb, |out| out.write_all(&mean))
        })?;
        Ok(PyBytes::new(py, &png.map_err(|error| PyValueError::new_err(error.to_string()))?))
    }
}

/// Pose of a camera above and behind the robot, or of the origin.
fn usual_pose(robot: Option<Pose>) -> Pose {
    let robot = robot.unwrap_or(Pose::IDENTITY);
    let yaw = robot.rpy().yaw;
    let (sine, cosine) = libm::sincos(yaw);
    let at = robot.translation;
    Pose::from_xyz_rpy(
        [at.x - BEHIND_M * cosine, at.y - BEHIND_M * sine, at.z + ABOVE_M],
        Rpy { roll: 0.0, pitch: DOWN_RAD, yaw },
    )
}

/// Means of squares of rays.
fn smaller(rgb: &[u8], width: usize) -> Vec<u8> {
    let side = RAYS_PER_SIDE as usize;
    let mut out = Vec::with_capacity(rgb.len() / (side * side));
    for rows in rgb.chunks_exact(3 * width * side) {
        for column in 0..width / side {
            for colour in 0..3 {
                let rays = (0..side).flat_map(|y| (0..side).map(move |x| (x, y)));
                let sum: usize = rays
                    .map(|(x, y)| usize::from(rows[(y * width + column * side + x) * 3 + colour]))
                    .sum();
                out.push((sum / (side * side)) as u8);
            }
        }
    }
    out
}
