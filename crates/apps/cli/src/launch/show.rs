//! Text output of launch files.

use std::io;

use periplus_launch::LaunchPlan;

/// Prints the arguments of a launch file, as `ros2 launch --show-args` does.
pub(super) fn arguments(out: &mut dyn io::Write, plan: &LaunchPlan) -> io::Result<()> {
    if plan.arguments.is_empty() {
        return writeln!(out, "No arguments.");
    }
    writeln!(out, "Arguments (pass arguments as '<name>:=<value>'):")?;
    for argument in &plan.arguments {
        writeln!(out, "\n    '{}':", argument.name)?;
        let description = argument.description.as_deref();
        writeln!(out, "        {}", description.unwrap_or("no description given"))?;
        if !argument.choices.is_empty() {
            writeln!(out, "        Valid choices are: {}", argument.choices.join(", "))?;
        }
        if let Some(default) = &argument.default {
            writeln!(out, "        (default: '{default}')")?;
        }
    }
    Ok(())
}
