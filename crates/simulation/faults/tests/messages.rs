//! Properties of faults of messages: loss, repetition and delay.
#![allow(clippy::unwrap_used, reason = "a test may panic")]

use periplus_diagnostics::{Diagnostics, SourceMap};
use periplus_faults::{FaultInjector, read_list};
use periplus_graph::{NodeSettings, Qos};
use periplus_msgs::std_msgs::Int32;
use periplus_sim::{Options, PhysicsMode, Search, Simulation, compose_plain};
use proptest::prelude::*;

/// Number of messages, one for each step of 10 ms.
const COUNT: i32 = 60;

/// Numbers that a subscription receives while 0, 1, 2, ... are published on `/numbers`.
fn received(faults: &str, seed: u64) -> Vec<i32> {
    let (mut sources, mut diagnostics) = (SourceMap::new(), Diagnostics::new());
    let file = sources.add("faults.yaml", faults);
    let tree = periplus_yaml::parse(file, &sources).unwrap().unwrap();
    let faults = read_list(&tree, &mut diagnostics);
    assert!(!diagnostics.has_errors(), "{diagnostics:?}");
    let mut world = Search::default().with_context(true, |context| compose_plain(&[], context));
    let options =
        Options { mode: PhysicsMode::Kinematic, step_s: Some(0.01), ..Options::default() };
    let mut simulation = Simulation::new(&mut world, Default::default(), options);
    let node = simulation.graph().node(NodeSettings::new("numbers")).unwrap();
    let publisher = node.publisher::<Int32>("/numbers", Qos::reliable(10)).unwrap();
    let mailbox = node.mailbox::<Int32>("/numbers", Qos::reliable(1000)).unwrap();
    let mut injector = FaultInjector::new(seed);
    for fault in faults {
        injector.add(&simulation, fault).unwrap();
    }
    // The delays are shorter than the steps after the last message.
    for number in 0..2 * COUNT {
        injector.update(&mut simulation);
        if number < COUNT {
            publisher.publish(Int32 { data: number });
        }
        simulation.step().unwrap();
    }
    injector.update(&mut simulation);
    mailbox.drain().iter().map(|message| message.data).collect()
}

#[test]
fn messages_of_a_window_are_lost() {
    let numbers = received("- dropout: {topic: /numbers, from: 0.1, until: 0.2}", 0);
    let wanted: Vec<i32> = (0..COUNT).filter(|number| !(10..20).contains(number)).collect();
    assert_eq!(numbers, wanted);
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 24, ..ProptestConfig::default() })]

    #[test]
    fn late_messages_arrive_all_and_in_order(
        mean in 0.0..0.2_f64, jitter in 0.0..0.05_f64, seed in any::<u64>()
    ) {
        let faults = format!("- latency: {{topic: numbers, mean: {mean}, jitter: {jitter}}}");
        prop_assert_eq!(received(&faults, seed), (0..COUNT).collect::<Vec<_>>());
    }

    #[test]
    fn reordered_messages_arrive_all(probability in 0.0..1.0_f64, seed in any::<u64>()) {
        let faults =
            format!("- reorder: {{topic: /numbers, probability: {probability}, delay: 0.05}}");
        let mut numbers = received(&faults, seed);
        numbers.sort_unstable();
        prop_assert_eq!(numbers, (0..COUNT).collect::<Vec<_>>());
    }

    #[test]
    fn lost_and_repeated_messages_depend_on_the_seed_alone(
        probability in 0.0..1.0_f64, seed in any::<u64>()
    ) {
        let faults = format!(
            "- packet_loss: {{topic: /numbers, enter: {probability}}}\n\
             - duplicate: {{topic: /numbers, probability: {probability}}}"
        );
        let numbers = received(&faults, seed);
        prop_assert!(numbers.is_sorted());
        prop_assert_eq!(&numbers, &received(&faults, seed));
    }
}
