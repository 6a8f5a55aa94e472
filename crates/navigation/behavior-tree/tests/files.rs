//! Reading and checking of files.
#![allow(
    clippy::unwrap_used,
    clippy::print_stderr,
    clippy::disallowed_methods,
    reason = "helpers of tests, which read shared files"
)]

mod support;

use std::fs;

use periplus_behavior_tree::{
    Blackboard, IncludedTree, NodeModel, NodeRegistry, NodeStatus, TreeFiles, TreeIncludeError,
    TreeValue, nav2,
};
use periplus_diagnostics::{Diagnostics, SourceMap};
use support::{Scripted, file, registry, shared};

/// Findings as `line:column: message`, with the text of a replacement.
fn listed(sources: &SourceMap, findings: &Diagnostics) -> Vec<String> {
    let line = |finding: &periplus_diagnostics::Diagnostic| {
        let position = finding.span.map(|span| sources.locate(span).1);
        let position = position.map_or(String::new(), |at| format!("{}:{}: ", at.line, at.column));
        let replacement = finding.replacement.as_ref();
        let replacement = replacement.map_or(String::new(), |it| format!(" ({})", it.message));
        format!("{position}{}{replacement}", finding.message)
    };
    findings.iter().map(line).collect()
}

/// Finds exactly this in the XML of a root node on line 2.
fn check(root: &str, expected: &str) {
    let xml =
        format!("<root BTCPP_format=\"4\"><BehaviorTree ID=\"T\">\n{root}</BehaviorTree></root>");
    check_file(&xml, expected);
}

fn check_file(xml: &str, expected: &str) {
    let registry = registry(&Scripted::default());
    let files = TreeFiles::parse("t.xml", xml, &registry);
    let findings = match files.tree("", &registry, Blackboard::new()) {
        Ok(_) => files.diagnostics.clone(),
        Err(findings) => findings,
    };
    assert_eq!(listed(&files.sources, &findings), [expected], "{xml}");
}

#[test]
fn faults_have_a_line_and_a_column() {
    check("<Sequnce><Leaf/></Sequnce>", "2:2: unknown node `Sequnce` (did you mean `Sequence`?)");
    check("<Action ID='Leav'/>", "2:13: unknown node `Leav` (did you mean `Leaf`?)");
    check("<Action/>", "2:1: <Action> needs an attribute `ID`");
    check("<Inverter/>", "2:2: `Inverter` has 0 children, and must have exactly one child");
    check("<Sequence/>", "2:2: `Sequence` has 0 children, and must have one or more children");
    check("<Leaf><Leaf/></Leaf>", "2:2: `Leaf` has 1 children, and must have no children");
    check(
        "<RateController hz='fast'><Leaf/></RateController>",
        "2:21: `fast` is not a value of type double",
    );
    check(
        "<DistanceController distanc='1'><Leaf/></DistanceController>",
        "2:21: `DistanceController` has no port `distanc` (did you mean `distance`?)",
    );
    check("<Script code='x := '/>", "2:20: script: an operand is missing here");
    check("<Leaf _skipIf='a ='/>", "2:19: script: an operand is missing here");
    check("<SubTree ID='U'/>", "2:14: there is no tree `U`");
    check("<Control ID='Leaf'/>", "2:2: `Leaf` is not of the kind Control");
    check("<Leaf _skipif='true'/>", "2:7: unknown attribute `_skipif` (did you mean `_skipIf`?)");
    check(
        "<Sequence><TimeExpired seconds='{x}'/><AreErrorCodesPresent error_code='{x}'/></Sequence>",
        "2:73: the entry `x` has the type double elsewhere, and uint16 here",
    );
    check_file("<tree/>", "1:2: the outermost element is <tree>, and not <root>");
    check_file("<root BTCPP_format='5'/>", "1:21: unknown format `5`");
    check_file("<root/>", "1:2: the file defines no <BehaviorTree>");
    let two = "<root><BehaviorTree ID='A'><Leaf/></BehaviorTree><BehaviorTree ID='B'><Leaf/></BehaviorTree></root>";
    check_file(two, "1:2: the file defines several trees, and none is the main one");
    let named = two.replace("<root>", "<root main_tree_to_execute='C'>");
    check_file(&named, "1:29: there is no tree `C`");
    let recursive = "<root><BehaviorTree ID='A'><SubTree ID='A'/></BehaviorTree></root>";
    check_file(recursive, "1:28: the tree `A` contains itself");
}

#[test]
fn too_large_trees_are_refused() {
    // Each tree uses the next one twice: 2^20 nodes.
    let trees: String = (0..20)
        .map(|i| {
            let next = format!("<SubTree ID='T{}'/>", i + 1);
            format!("<BehaviorTree ID='T{i}'><Sequence>{next}{next}</Sequence></BehaviorTree>")
        })
        .collect();
    let last = "<BehaviorTree ID='T20'><Leaf/></BehaviorTree>";
    let xml = format!("<root main_tree_to_execute='T0'>{trees}{last}</root>");
    let registry = registry(&Scripted::default());
    let files = TreeFiles::parse("t.xml", &xml, &registry);
    let findings = files.tree("", &registry, Blackboard::new()).unwrap_err();
    assert!(listed(&files.sources, &findings)[0].contains("more than 10000 nodes"));
    // Nested subtrees reach the depth limit with few nodes.
    let open = "<Inverter>".repeat(120);
    let close = "</Inverter>".repeat(120);
    let inner = format!("<BehaviorTree ID='B'>{open}<SubTree ID='C'/>{close}</BehaviorTree>");
    let innermost = format!("<BehaviorTree ID='C'>{open}<Leaf/>{close}</BehaviorTree>");
    let outer = format!("<BehaviorTree ID='A'>{open}<SubTree ID='B'/>{close}</BehaviorTree>");
    let xml = format!("<root main_tree_to_execute='A'>{outer}{inner}{innermost}</root>");
    let files = TreeFiles::parse("t.xml", &xml, &registry);
    let findings = files.tree("", &registry, Blackboard::new()).unwrap_err();
    assert!(listed(&files.sources, &findings)[0].contains("nested more than 256 deep"));
    // Within the limit it also runs.
    let xml = format!("<root main_tree_to_execute='B'>{inner}{innermost}</root>");
    let mut tree = file(&xml, &Scripted::default());
    assert_eq!(tree.tick(0, &mut ()), Ok(NodeStatus::Success));
}

#[test]
fn subtrees_have_ports() {
    let xml = "<root BTCPP_format='4' main_tree_to_execute='M'>
      <BehaviorTree ID='M'><Sequence>
        <Script code=\"a := 1; shared := 5; _private := 7\"/>
        <SubTree ID='S' x='{a}' y='text' z='2'/>
        <SubTree ID='R' _autoremap='true'/>
      </Sequence></BehaviorTree>
      <BehaviorTree ID='S'><Script code=\"@sum := x + z; @text := y; x += 10; local := 1\"/></BehaviorTree>
      <BehaviorTree ID='R'><Script code=\"shared += 1; _private := 0\"/></BehaviorTree></root>";
    let mut tree = file(xml, &Scripted::default());
    assert_eq!(tree.tick(0, &mut ()), Ok(NodeStatus::Success));
    let value = |key: &str| tree.blackboard().get(key).cloned();
    assert_eq!(value("sum"), Some(TreeValue::Real(3.0)));
    assert_eq!(value("text"), Some("text".into()));
    assert_eq!(value("a"), Some(TreeValue::Real(11.0)));
    assert_eq!(value("shared"), Some(TreeValue::Real(6.0)));
    assert_eq!(value("_private"), Some(TreeValue::Int(7)));
    assert_eq!(value("local"), None);
}

#[test]
fn subtrees_of_format_3_name_entries_without_braces() {
    let xml = "<root main_tree_to_execute='M'>
      <BehaviorTree ID='M'><Sequence>
        <SetBlackboard output_key='a' value='1'/>
        <SubTree ID='S' inner='a'/>
        <SubTree ID='T' __shared_blackboard='true'/>
        <SubTreePlus ID='U' b='{a}' c='text'/>
      </Sequence></BehaviorTree>
      <BehaviorTree ID='S'><SetBlackboard output_key='inner' value='2'/></BehaviorTree>
      <BehaviorTree ID='T'><SetBlackboard output_key='from_t' value='{a}'/></BehaviorTree>
      <BehaviorTree ID='U'><SetBlackboard output_key='b' value='{c}'/></BehaviorTree></root>";
    let mut tree = file(xml, &Scripted::default());
    assert_eq!(tree.tick(0, &mut ()), Ok(NodeStatus::Success));
    assert_eq!(tree.blackboard().get("from_t"), Some(&"2".into()));
    assert_eq!(tree.blackboard().get("a"), Some(&"text".into()));
}

#[test]
fn models_of_subtrees_give_defaults_and_demand_ports() {
    let file = |attributes: &str| {
        format!(
            "<root BTCPP_format='4' main_tree_to_execute='M'>
      <TreeNodesModel><SubTree ID='S'><input_port name='x' default='4'/><input_port name='y'/>
      </SubTree></TreeNodesModel>
      <BehaviorTree ID='M'><SubTree ID='S' {attributes}/></BehaviorTree>
      <BehaviorTree ID='S'><ScriptCondition code='x == 4'/></BehaviorTree></root>"
        )
    };
    let mut tree = support::file(&file("y='1'"), &Scripted::default());
    assert_eq!(tree.tick(0, &mut ()), Ok(NodeStatus::Success));
    check_file(&file(""), "4:28: the subtree needs an attribute `y`");
}

#[test]
fn includes_are_resolved_by_the_caller() {
    let registry = registry(&Scripted::default());
    let main = "<root BTCPP_format='4' main_tree_to_execute='M'><include path='sub.xml'/>
      <BehaviorTree ID='M'><SubTree ID='S'/></BehaviorTree></root>";
    let sub = |node: &str| {
        let xml =
            format!("<root BTCPP_format='4'><BehaviorTree ID='S'>{node}</BehaviorTree></root>");
        IncludedTree { name: "/x/sub.xml".into(), text: xml }
    };
    let load = |included: Result<IncludedTree, TreeIncludeError>| {
        TreeFiles::load("/x/main.xml", main, &registry, &mut |include| {
            assert_eq!((include.path, include.from), ("sub.xml", "/x/main.xml"));
            included.clone()
        })
    };
    assert!(load(Ok(sub("<Leaf/>"))).tree("", &registry, Blackboard::new()).is_ok());
    let files = load(Ok(sub("<Leav/>")));
    let finding = files.diagnostics.iter().next().unwrap();
    assert_eq!(files.sources.locate(finding.span.unwrap()).0, "/x/sub.xml");
    let files = load(Err(TreeIncludeError::Unreadable("there is no such file".into())));
    assert_eq!(
        listed(&files.sources, &files.diagnostics)[0],
        "1:49: cannot include `sub.xml`: there is no such file"
    );
    let endless = "<root><include path='a'/></root>";
    let files = TreeFiles::load("a", endless, &registry, &mut |_| {
        Ok(IncludedTree { name: "b".into(), text: endless.into() })
    });
    assert!(listed(&files.sources, &files.diagnostics)[0].contains("includes itself"));
    let mut count = 0;
    let files = TreeFiles::load("a", endless, &registry, &mut |_| {
        count += 1;
        Ok(IncludedTree { name: format!("b{count}"), text: endless.into() })
    });
    assert!(listed(&files.sources, &files.diagnostics)[0].contains("too many included files"));
}

/// Trees that Nav2 has, with leaves by the models of Nav2's file: no findings.
#[test]
fn stock_trees_of_nav2_load_without_findings() {
    let Some(folder) = shared("nav/behavior_trees") else { return };
    let mut count = 0;
    for (distro, rules) in [
        ("humble", nav2::Nav2NodeRules::JAZZY),
        ("jazzy", nav2::Nav2NodeRules::JAZZY),
        ("main", nav2::Nav2NodeRules::MAIN),
    ] {
        let scripted = Scripted::default();
        let mut registry = NodeRegistry::new();
        nav2::register(&mut registry, rules);
        let text = fs::read_to_string(folder.join(distro).join("nav2_tree_nodes.xml")).unwrap();
        let mut sources = SourceMap::new();
        let id = sources.add("nav2_tree_nodes.xml", text);
        let document = periplus_xml::parse(id, &sources, &mut Diagnostics::new()).unwrap();
        for mut model in NodeModel::read_all(&document.root) {
            if let Some(known) = registry.model(&model.name) {
                // Its ports are ports here, with the same defaults.
                for port in &model.ports {
                    let ours = known.find(&port.name);
                    let ours =
                        ours.unwrap_or_else(|| panic!("{distro}: {} {}", model.name, port.name));
                    let is_wrap = port.name == "wrap_around";
                    assert!(is_wrap || port.default.is_none() || ours.default == port.default);
                }
                continue;
            }
            // Ports that shipped trees use although the file does not list them.
            for name in ["is_recovery", "error_code_id", "error_msg", "input_path", "path"] {
                if model.find(name).is_none() {
                    model = model.input(name, periplus_behavior_tree::PortType::Any);
                }
            }
            scripted.register(&mut registry, model);
        }
        for entry in fs::read_dir(folder.join(distro)).unwrap() {
            let path = entry.unwrap().path();
            if path.ends_with("nav2_tree_nodes.xml") {
                continue;
            }
            let text = fs::read_to_string(&path).unwrap();
            let files = TreeFiles::parse(&path.display().to_string(), &text, &registry);
            assert_eq!(listed(&files.sources, &files.diagnostics), [""; 0], "{}", path.display());
            let tree = files.tree("", &registry, Blackboard::new());
            let tree = tree.map_err(|findings| listed(&files.sources, &findings));
            tree.unwrap_or_else(|findings| panic!("{}: {findings:?}", path.display()));
            count += 1;
        }
    }
    assert_eq!(count, 12 + 12 + 15);
}
