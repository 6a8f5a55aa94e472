//! Prints the table of the published experiments beside both models: `cargo xtask crowds`.
#![allow(clippy::print_stdout, reason = "the tables are its result")]

use periplus_crowds::experiments::{
    bottleneck, chattaraj_speed_m_per_s, lanes, plane_speed_m_per_s, seyfried_flow_per_s,
    seyfried_speed_m_per_s, single_file, weidmann_speed_m_per_s,
};
use periplus_crowds::{CrowdError, OrcaParams, SteeringModel};

/// Runs of each experiment with other people.
fn seeds() -> [u64; 3] {
    [1, 2, 3]
}

fn main() -> Result<(), CrowdError> {
    let paper = SteeringModel::Orca(OrcaParams { headway: None, ..OrcaParams::default() });
    let named =
        SteeringModel::NAMES.iter().filter_map(|name| Some((*name, SteeringModel::named(name)?)));
    let models: Vec<(&str, SteeringModel)> = named.chain([("orca, no headway", paper)]).collect();
    let spread = |values: Vec<f64>| {
        let mean = values.iter().sum::<f64>() / seeds().len() as f64;
        let low = values.iter().copied().fold(f64::INFINITY, f64::min);
        let high = values.iter().copied().fold(f64::NEG_INFINITY, f64::max);
        format!("{mean:.2} ({low:.2} to {high:.2})")
    };
    println!("specific flow of a bottleneck [1/(m s)]");
    println!("| width [m] | published | {} |", heads(&models));
    for width_m in [0.8, 0.9, 1.0, 1.1, 1.2, 1.6, 2.0, 2.5] {
        let published = if width_m > 1.2 {
            "1.6 to 1.9".to_owned()
        } else {
            format!("{:.2}", seyfried_flow_per_s(width_m) / width_m)
        };
        let mut row = format!("| {width_m:.1} | {published}");
        for (_, model) in &models {
            let people = if width_m > 1.2 { 150 } else { 60 };
            let runs: Result<Vec<_>, _> =
                seeds().iter().map(|seed| bottleneck(*model, width_m, people, *seed)).collect();
            let runs = runs?;
            let stuck: usize = runs.iter().map(|run| people - run.passed).sum();
            row += &format!(
                " | {}",
                spread(runs.iter().map(|run| run.specific_flow_per_m_s).collect())
            );
            if stuck > 0 {
                row += &format!(", {stuck} stuck");
            }
        }
        println!("{row} |");
    }
    println!("\nspeed in a single file [m/s]");
    println!("| density [1/m] | Germany 2005, India 2009 | {} |", heads(&models));
    for people in [5, 10, 15, 20, 25, 30, 34] {
        let density = people as f64 / 17.3;
        let published = [seyfried_speed_m_per_s(density), chattaraj_speed_m_per_s(density)];
        let mut row = format!("| {density:.2} | {:.2}, {:.2}", published[0], published[1]);
        for (_, model) in &models {
            let runs: Result<Vec<_>, _> =
                seeds().iter().map(|seed| single_file(*model, people, *seed)).collect();
            let runs = runs?;
            row += &format!(" | {}", spread(runs.iter().map(|run| run.speed_m_per_s).collect()));
            let overtakings: usize = runs.iter().map(|run| run.overtakings).sum();
            if overtakings > 0 {
                row += &format!(", {overtakings} overtakings");
            }
        }
        println!("{row} |");
    }
    println!("\nspeed in the plane [m/s]");
    println!("| density [1/m²] | Weidmann 1993 | {} |", heads(&models));
    for density in [0.2, 0.5, 1.0, 1.5, 2.0, 2.5, 3.0, 4.0] {
        let mut row = format!("| {density:.1} | {:.2}", weidmann_speed_m_per_s(density));
        for (_, model) in &models {
            let runs: Result<Vec<_>, _> =
                seeds().iter().map(|seed| plane_speed_m_per_s(*model, density, *seed)).collect();
            row += &format!(" | {}", spread(runs?));
        }
        println!("{row} |");
    }
    println!("\ntwo directions: order at the start, at the end, seconds to 0.8, speed [m/s]");
    println!("| density [1/m²] | {} |", heads(&models));
    for density in [0.3, 0.7, 1.0, 1.5, 2.0] {
        let mut row = format!("| {density:.1}");
        for (_, model) in &models {
            let runs: Result<Vec<_>, _> =
                seeds().iter().map(|seed| lanes(*model, density, 120.0, *seed)).collect();
            let runs = runs?;
            let mean = |pick: &dyn Fn(&periplus_crowds::experiments::LanesRun) -> f64| {
                runs.iter().map(pick).sum::<f64>() / seeds().len() as f64
            };
            let times: Vec<String> = runs
                .iter()
                .map(|run| run.ordered_after_s.map_or("-".into(), |time| format!("{time:.0}")))
                .collect();
            row += &format!(
                " | {:.2}, {:.2}, {}, {:.2}",
                mean(&|run| run.order_at_start),
                mean(&|run| run.order_at_end),
                times.join("/"),
                mean(&|run| run.speed_m_per_s)
            );
        }
        println!("{row} |");
    }
    Ok(())
}

fn heads(models: &[(&str, SteeringModel)]) -> String {
    models.iter().map(|(name, _)| *name).collect::<Vec<_>>().join(" | ")
}
