//! What a person reads about a launch file.

use std::io;

use periplus_launch::{Plan, Trigger, What};

/// The arguments that a file takes, as `ros2 launch --show-args` lists them.
pub(super) fn arguments(out: &mut dyn io::Write, plan: &Plan) -> io::Result<()> {
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

/// What a file starts, a line each.
pub(super) fn steps(out: &mut dyn io::Write, plan: &Plan) -> io::Result<()> {
    for step in &plan.steps {
        let what = match &step.what {
            What::Node(node) => {
                let program = match &node.package {
                    Some(package) => format!("{package} {}", node.executable),
                    None => node.executable.clone(),
                };
                let name = node.identity.name.as_deref().unwrap_or(&node.executable);
                let name = format!("{}/{name}", node.identity.namespace.as_deref().unwrap_or(""));
                format!("node {program} as {name}")
            }
            What::Load { container, components } => {
                let plugins: Vec<&str> =
                    components.iter().map(|component| component.plugin.as_str()).collect();
                format!("load {} into {container}", plugins.join(", "))
            }
            What::Process(process) => format!("run {}", process.command.join(" ")),
            What::Transition { step, transition } => match step {
                Some(step) => format!("{transition} step {step}"),
                None => format!("{transition} all managed nodes"),
            },
            What::Log { text, .. } => format!("say {text}"),
            What::Include { file, .. } => format!("include {file}"),
            What::Shutdown { reason } => format!("end everything: {reason}"),
        };
        let after: String = step.after.iter().map(when).collect();
        writeln!(out, "{:>4}  {after}{what}", step.id)?;
    }
    Ok(())
}

fn when(trigger: &Trigger) -> String {
    let of = |step: &Option<usize>| match step {
        Some(step) => format!("step {step}"),
        None => "anything".to_owned(),
    };
    match trigger {
        Trigger::Seconds(seconds) => format!("{seconds} s later: "),
        Trigger::Started(step) => format!("when {} has started: ", of(step)),
        Trigger::Ended(step) => format!("when {} has ended: ", of(step)),
        Trigger::Printed(step) => format!("when {} has printed something: ", of(step)),
        Trigger::Reached { step, to, .. } => {
            format!("when {} is {}: ", of(step), to.as_deref().unwrap_or("in another state"))
        }
        Trigger::Shutdown => "at the end: ".to_owned(),
    }
}
