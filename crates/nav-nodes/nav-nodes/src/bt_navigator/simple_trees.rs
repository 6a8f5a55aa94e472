//! Built-in trees without recoveries. They differ in the rule for a new path.

use periplus_costmap::Nav2Release;

/// File names of the trees.
pub(super) const FILES: [&str; 7] = [
    "follow_point.xml",
    "navigate_w_replanning_distance.xml",
    "navigate_w_replanning_only_if_goal_is_updated.xml",
    "navigate_w_replanning_only_if_path_becomes_invalid.xml",
    "navigate_w_replanning_speed.xml",
    "navigate_w_replanning_time.xml",
    "odometry_calibration.xml",
];

/// Text of a tree; none for other names.
pub(super) fn text(release: Nav2Release, file_name: &str) -> Option<String> {
    let id = file_name.strip_suffix(".xml").filter(|_| FILES.contains(&file_name))?;
    let body = match id {
        "odometry_calibration" => square(),
        "follow_point" => follow_point(release),
        _ => replanning(release, id)?,
    };
    let format = if release == Nav2Release::Humble { "" } else { " BTCPP_format=\"4\"" };
    Some(format!(
        "<root{format} main_tree_to_execute=\"{id}\">\n<BehaviorTree ID=\"{id}\">\n{body}\n</BehaviorTree>\n</root>\n"
    ))
}

/// Choice of the plugins, as later releases have it.
fn selectors(release: Nav2Release) -> &'static str {
    if release == Nav2Release::Humble {
        return "";
    }
    "<ControllerSelector default_controller=\"FollowPath\" selected_controller=\"{selected_controller}\"/>
<PlannerSelector default_planner=\"GridBased\" selected_planner=\"{selected_planner}\"/>"
}

fn plan(release: Nav2Release, goal: &str) -> String {
    let (planner, errors) = match release {
        Nav2Release::Humble => ("GridBased", ""),
        _ => (
            "{selected_planner}",
            " error_code_id=\"{compute_path_error_code}\" error_msg=\"{compute_path_error_msg}\"",
        ),
    };
    format!(
        "<ComputePathToPose goal=\"{{{goal}}}\" planner_id=\"{planner}\" path=\"{{path}}\"{errors}/>"
    )
}

fn follow(release: Nav2Release, path: &str) -> String {
    let (controller, errors) = match release {
        Nav2Release::Humble => ("FollowPath", ""),
        _ => (
            "{selected_controller}",
            " error_code_id=\"{follow_path_error_code}\" error_msg=\"{follow_path_error_msg}\" \
             tracking_feedback=\"{tracking_feedback}\"",
        ),
    };
    format!("<FollowPath path=\"{{{path}}}\" controller_id=\"{controller}\"{errors}/>")
}

/// Plans by a rule and follows.
fn replanning(release: Nav2Release, id: &str) -> Option<String> {
    let rule = match id {
        "navigate_w_replanning_distance" => "DistanceController distance=\"1.0\"",
        "navigate_w_replanning_only_if_goal_is_updated" => "GoalUpdatedController",
        "navigate_w_replanning_speed" => {
            "SpeedController min_rate=\"0.1\" max_rate=\"1.0\" min_speed=\"0.0\" max_speed=\"0.26\""
        }
        "navigate_w_replanning_time" | "navigate_w_replanning_only_if_path_becomes_invalid" => {
            "RateController hz=\"1.0\""
        }
        _ => return None,
    };
    let mut planning = plan(release, "goal");
    if id == "navigate_w_replanning_only_if_path_becomes_invalid" {
        let check = if release == Nav2Release::Main { "ValidatePath" } else { "IsPathValid" };
        planning = format!(
            "<Fallback>
<ReactiveSequence><Inverter><GlobalUpdatedGoal/></Inverter><{check} path=\"{{path}}\"/></ReactiveSequence>
{planning}
</Fallback>"
        );
    }
    let (selectors, follow) = (selectors(release), follow(release, "path"));
    let name = rule.split(' ').next().unwrap_or_default();
    Some(format!(
        "<PipelineSequence>\n{selectors}\n<{rule}>\n{planning}\n</{name}>\n{follow}\n</PipelineSequence>"
    ))
}

/// Follows a goal that moves, at a distance.
fn follow_point(release: Nav2Release) -> String {
    let plan = plan(release, "updated_goal");
    let (selectors, follow) = (selectors(release), follow(release, "truncated_path"));
    format!(
        "<PipelineSequence>
{selectors}
<RateController hz=\"1.0\">
<Sequence>
<GoalUpdater input_goal=\"{{goal}}\" output_goal=\"{{updated_goal}}\">
{plan}
</GoalUpdater>
<TruncatePath distance=\"1.0\" input_path=\"{{path}}\" output_path=\"{{truncated_path}}\"/>
</Sequence>
</RateController>
<KeepRunningUntilFailure>
{follow}
</KeepRunningUntilFailure>
</PipelineSequence>"
    )
}

/// Drives in a square, three times.
fn square() -> String {
    let side = "<DriveOnHeading dist_to_travel=\"2.0\" speed=\"0.2\" time_allowance=\"12\" \
                error_code_id=\"{drive_on_heading_error_code}\" error_msg=\"{drive_on_heading_error_msg}\"/>
<Spin spin_dist=\"1.570796\" is_recovery=\"false\" error_code_id=\"{spin_error_code}\" error_msg=\"{spin_error_msg}\"/>\n";
    format!("<Repeat num_cycles=\"3\">\n<Sequence>\n{}</Sequence>\n</Repeat>", side.repeat(4))
}
