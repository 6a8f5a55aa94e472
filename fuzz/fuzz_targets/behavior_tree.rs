//! A file of trees with an included file: a tree, or an error with a position, and some ticks of the tree. The
//! two are separated by a line of `=====`.
#![no_main]

use libfuzzer_sys::fuzz_target;
use periplus_behavior_tree::{
    Blackboard, IncludedTree, NodeKind, NodeModel, NodeRegistry, NodeStatus, PortType, TreeFiles, nav2,
};
use periplus_diagnostics::{RenderStyle, render};

/// Leaf that runs once, then alternates.
fn registry() -> NodeRegistry {
    let mut registry = NodeRegistry::new();
    nav2::register(&mut registry, nav2::Nav2NodeRules::MAIN);
    let leaf = NodeModel::new("Leaf", NodeKind::Action)
        .in_out("count", PortType::int())
        .input("value", PortType::real());
    registry.register_leaf(leaf, |run| {
        let count = run.input_i64("count").unwrap_or(0);
        run.set_output("count", count.wrapping_add(1))?;
        Ok([NodeStatus::Running, NodeStatus::Failure, NodeStatus::Success][count.rem_euclid(3) as usize])
    });
    registry
}

fuzz_target!(|text: &str| {
    let (main, part) = text.split_once("\n=====\n").unwrap_or((text, ""));
    let registry = registry();
    let files = TreeFiles::load("main.xml", main, &registry, &mut |include| {
        Ok(IncludedTree { name: include.path.to_owned(), text: part.to_owned() })
    });
    let tree = files.tree("", &registry, Blackboard::new());
    let mut tree = match tree {
        Ok(tree) => tree,
        Err(findings) => {
            assert!(findings.has_errors());
            for finding in findings.iter().take(20) {
                let _ = render(finding, &files.sources, RenderStyle::Plain);
            }
            return;
        }
    };
    for tick in 0..5 {
        if tree.tick(tick * 100_000_000, &mut ()).is_err() {
            break;
        }
    }
    let _ = tree.halt(500_000_000, &mut ());
    assert!(tree.nodes().all(|node| node.status != NodeStatus::Running), "halted");
});
