//! Hostile files: each fails within bounded time and memory, with an error.

mod common;

use std::fmt::Write as _;
use std::path::Path;

use periplus_diagnostics::Severity;
use periplus_resources::MemoryHost;

use common::read;

/// The codes of the errors in a file, each once, in order.
fn errors(name: &str, text: impl Into<Vec<u8>>) -> Vec<&'static str> {
    let host = MemoryHost::new()
        .with_file(Path::new("/r").join(name), text)
        .with_file("/etc/passwd", "root:secret:0:0");
    let loaded = read(&host, Path::new("/r"), Path::new(name), &[]);
    let said = common::shown(&loaded);
    assert!(!said.contains("secret"), "a file outside was shown: {said}");
    assert!(said.len() < 3_000_000, "findings of {} bytes", said.len());
    let mut codes: Vec<_> = loaded
        .diagnostics
        .iter()
        .filter(|finding| finding.severity == Severity::Error)
        .map(|finding| finding.code)
        .collect();
    codes.dedup();
    codes.truncate(5);
    codes
}

fn world(content: &str) -> String {
    format!("<sdf version='1.9'><world name='w'>{content}</world></sdf>")
}

fn xacro(content: &str) -> String {
    format!("<robot name='r' xmlns:xacro='http://www.ros.org/wiki/xacro'>{content}</robot>")
}

#[test]
fn ten_thousand_levels() {
    let nested = |open: &str, close: &str| open.repeat(10_000) + &close.repeat(10_000);
    assert_eq!(errors("a.sdf", world(&nested("<model name='m'>", "</model>"))), ["too-deep"]);
    assert_eq!(errors("a.urdf", nested("<robot>", "</robot>")), ["too-deep"]);
    assert_eq!(errors("a.xacro", xacro(&nested("<a>", "</a>"))), ["too-deep"]);
}

#[test]
fn an_entity_bomb() {
    let mut text = String::from("<!DOCTYPE s [<!ENTITY e0 'ha'>");
    for level in 1..20 {
        let _ = write!(text, "<!ENTITY e{level} '{}'>", format!("&e{};", level - 1).repeat(10));
    }
    text += "]><sdf version='1.9'><world name='&e19;'/></sdf>";
    assert_eq!(errors("a.sdf", text), ["entity-bomb"]);
}

#[test]
fn a_file_that_includes_itself() {
    let itself = "<model name='m'><include><uri>a.sdf</uri></include></model>";
    let text = format!("<sdf version='1.9'>{itself}</sdf>");
    assert_eq!(errors("a.sdf", text), ["include-cycle"]);
    let text = xacro("<xacro:include filename='a.xacro'/>");
    assert_eq!(errors("a.xacro", text), ["include-cycle"]);
}

#[test]
fn macros_that_never_end() {
    let endless = "<xacro:macro name='a'><xacro:a/></xacro:macro><xacro:a/>";
    assert_eq!(errors("a.xacro", xacro(endless)), ["too-deep"]);
    let mut doubling: String = (0..60)
        .map(|i| {
            format!("<xacro:macro name='a{i}'><xacro:a{0}/><xacro:a{0}/></xacro:macro>", i + 1)
        })
        .collect();
    doubling += "<xacro:macro name='a60'><x/></xacro:macro><xacro:a0/>";
    assert_eq!(errors("a.xacro", xacro(&doubling)), ["too-large"]);
}

#[test]
fn expressions_that_never_end() {
    for expression in
        ["10**10**10", "[0] * 10**12", "len([x for x in range(10**12)])", "'a' * 10**12"]
    {
        let text = xacro(&format!("<link name=\"${{{expression}}}\"/>"));
        assert_eq!(errors("a.xacro", text), ["expression"], "{expression}");
    }
}

#[test]
fn python_tricks_are_no_python() {
    for expression in
        ["(1).__class__", "''.__class__.__mro__", "__import__('os')", "open('/etc/passwd')"]
    {
        let text = xacro(&format!("<link name=\"${{{expression}}}\"/>"));
        assert_eq!(errors("a.xacro", text), ["expression"], "{expression}");
    }
}

#[test]
fn files_outside_are_not_read() {
    let include = |uri: &str| world(&format!("<include><uri>{uri}</uri></include>"));
    for uri in [
        "/etc/passwd",
        "file:///etc/passwd",
        "../../../etc/passwd",
        "model://../etc/passwd",
        "package://a/../../etc/passwd",
    ] {
        assert_eq!(errors("a.sdf", include(uri)), ["missing-include"], "{uri}");
        let text = xacro(&format!("<xacro:include filename='{uri}'/>"));
        assert_eq!(errors("a.xacro", text).len(), 1, "{uri}");
    }
    let text = xacro("<link name=\"${xacro.load_yaml('/etc/passwd')}\"/>");
    assert_eq!(errors("a.xacro", text), ["resource-outside"]);
}

#[test]
fn numbers_that_are_none() {
    for number in ["nan", "inf", "1e999", "-1e999", "0x", "1,5,,", "--1"] {
        let link = format!("<link name='l'><pose>{number} 0 0 0 0 0</pose></link>");
        let text = format!("<sdf version='1.9'><model name='m'>{link}</model></sdf>");
        assert!(!errors("a.sdf", text).is_empty(), "{number} as a pose");
        let text = format!(
            "<robot name='r'><link name='l'><inertial><mass value='{number}'/><inertia ixx='1' iyy='1' izz='1' ixy='0' ixz='0' iyz='0'/></inertial></link></robot>"
        );
        assert!(!errors("a.urdf", text).is_empty(), "{number} as a mass");
    }
}

#[test]
fn two_billion_models_in_a_population() {
    let text = world(
        "<population name='p'><model name='m'><link name='l'/></model><box><size>1 1 1</size></box>\
         <model_count>2000000000</model_count><distribution><type>random</type></distribution></population>",
    );
    assert_eq!(errors("a.sdf", text), ["out-of-range"]);
}

#[test]
fn long_chains_of_frames_and_links() {
    let mut model = String::from("<link name='l0'/>");
    let mut robot = String::from("<link name='l0'/>");
    for i in 1..20_000 {
        let before = i - 1;
        let _ = write!(
            model,
            "<link name='l{i}'><pose relative_to='l{before}'>1 0 0 0 0 0</pose></link>"
        );
        let _ = write!(
            robot,
            "<link name='l{i}'/><joint name='j{i}' type='fixed'><parent link='l{before}'/><child link='l{i}'/></joint>"
        );
    }
    let text = format!("<sdf version='1.9'><model name='m'>{model}</model></sdf>");
    assert_eq!(errors("a.sdf", text), [""; 0]);
    let _ = errors("a.urdf", format!("<robot name='r'>{robot}</robot>"));
}

#[test]
fn the_same_slip_a_hundred_thousand_times() {
    let text = format!(
        "<sdf version='1.9'><model name='m'>{}</model></sdf>",
        "<link name='l'/>".repeat(100_000)
    );
    assert_eq!(errors("a.sdf", text), ["duplicate-name"]);
}

#[test]
fn an_attribute_of_twenty_megabytes() {
    let text = format!("<sdf version='1.9'><world name='{}'/></sdf>", "x".repeat(20_000_000));
    let _ = errors("a.sdf", text);
}

#[test]
fn bytes_that_are_no_text() {
    let bytes: Vec<u8> = (0..=255).cycle().take(10_000).collect();
    assert!(!errors("a.sdf", bytes.clone()).is_empty());
    assert!(!errors("a.xacro", bytes.clone()).is_empty());
    assert!(!errors("a.stl", bytes).is_empty());
    assert!(!errors("a.urdf", "").is_empty());
}
