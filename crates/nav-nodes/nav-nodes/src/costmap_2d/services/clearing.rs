//! Clear services.
//!
//! Up to Jazzy the responses are empty and all clearable layers are cleared; errors are logged.
//! Later releases have layer names in the request and `success` in the response.

use periplus_costmap::Nav2Release;
use periplus_costmap::clear::{Region, clear};
use periplus_geometry::Pose2;
use periplus_graph::{Actor, GraphError, Level, Node};
use periplus_msgs::geometry_msgs::PoseStamped;
use periplus_msgs::{Service, nav2_msgs, nav2_msgs_main};

use crate::costmap_2d::node::CostmapNode;

/// Contents of a request.
struct Wish<'a> {
    region: Option<Region>,
    plugins: &'a [String],
}

/// Serves the clear services of a distribution, with its types.
pub(super) fn serve(
    actor: &mut Actor<CostmapNode>,
    name: &str,
    forms: Nav2Release,
) -> Result<(), GraphError> {
    let entirely = format!("clear_entirely_{name}");
    let around = format!("clear_around_{name}");
    let except = format!("clear_except_{name}");
    let around_pose = format!("clear_around_pose_{name}");
    if forms.clears_by_name() {
        use nav2_msgs_main::{
            ClearCostmapAroundPose, ClearCostmapAroundPoseResponse, ClearCostmapAroundRobot,
            ClearCostmapAroundRobotResponse, ClearCostmapExceptRegion,
            ClearCostmapExceptRegionResponse, ClearEntireCostmap, ClearEntireCostmapResponse,
        };
        one::<ClearEntireCostmap>(
            actor,
            &entirely,
            |request, _| Wish { region: Some(Region::Everything), plugins: &request.plugins },
            |success| ClearEntireCostmapResponse { success },
        )?;
        one::<ClearCostmapAroundRobot>(
            actor,
            &around,
            |request, state| Wish {
                region: state.around(request.reset_distance.into()),
                plugins: &request.plugins,
            },
            |success| ClearCostmapAroundRobotResponse { success },
        )?;
        one::<ClearCostmapExceptRegion>(
            actor,
            &except,
            |request, state| Wish {
                region: state.except(request.reset_distance.into()),
                plugins: &request.plugins,
            },
            |success| ClearCostmapExceptRegionResponse { success },
        )?;
        one::<ClearCostmapAroundPose>(
            actor,
            &around_pose,
            |request, state| Wish {
                region: state.around_pose(&request.pose, request.reset_distance),
                plugins: &request.plugins,
            },
            |success| ClearCostmapAroundPoseResponse { success },
        )
    } else {
        use nav2_msgs::{
            ClearCostmapAroundPose, ClearCostmapAroundRobot, ClearCostmapExceptRegion,
            ClearEntireCostmap,
        };
        let all: &[String] = &[];
        one::<ClearEntireCostmap>(
            actor,
            &entirely,
            |_, _| Wish { region: Some(Region::Everything), plugins: all },
            |_| Default::default(),
        )?;
        one::<ClearCostmapAroundRobot>(
            actor,
            &around,
            |request, state| Wish {
                region: state.around(request.reset_distance.into()),
                plugins: all,
            },
            |_| Default::default(),
        )?;
        one::<ClearCostmapExceptRegion>(
            actor,
            &except,
            |request, state| Wish {
                region: state.except(request.reset_distance.into()),
                plugins: all,
            },
            |_| Default::default(),
        )?;
        if !forms.clears_around_poses() {
            return Ok(());
        }
        one::<ClearCostmapAroundPose>(
            actor,
            &around_pose,
            |request, state| Wish {
                region: state.around_pose(&request.pose, request.reset_distance),
                plugins: all,
            },
            |_| Default::default(),
        )
    }
}

fn one<S: Service>(
    actor: &mut Actor<CostmapNode>,
    name: &str,
    wish: impl for<'a> Fn(&'a S::Request, &CostmapNode) -> Wish<'a> + Send + 'static,
    answer: impl Fn(bool) -> S::Response + Send + 'static,
) -> Result<(), GraphError> {
    actor.serve::<S>(name, move |state, request, io| {
        let wish = wish(&request, state);
        answer(state.clear(wish, io.node()))
    })
}

impl CostmapNode {
    fn around(&self, side_m: f64) -> Option<Region> {
        self.robot.map(|Pose2 { x_m, y_m, .. }| Region::Around { x_m, y_m, side_m })
    }

    fn except(&self, side_m: f64) -> Option<Region> {
        self.robot.map(|Pose2 { x_m, y_m, .. }| Region::Except { x_m, y_m, side_m })
    }

    fn around_pose(&self, pose: &PoseStamped, side_m: f64) -> Option<Region> {
        let Pose2 { x_m, y_m, .. } = self.placed(pose)?;
        Some(Region::Around { x_m, y_m, side_m })
    }

    /// Clears an area; returns true on success.
    fn clear(&mut self, wish: Wish<'_>, node: &Node) -> bool {
        let done = match (&mut self.costmap, wish.region) {
            (None, _) => Err("the costmap is not configured".to_owned()),
            (_, None) => Err("the position is unknown: a transform is missing".to_owned()),
            (Some(costmap), Some(region)) => {
                clear(costmap, region, wish.plugins).map_err(|error| error.to_string())
            }
        };
        if wish.region == Some(Region::Everything)
            && let Some(outputs) = &mut self.outputs
        {
            outputs.request_full();
        }
        match &done {
            Ok(()) => node.log(Level::Info, "cleared"),
            Err(why) => node.log(Level::Error, format_args!("cannot clear: {why}")),
        }
        done.is_ok()
    }
}
