//! Behavior trees in the XML of BehaviorTree.CPP, versions 3 and 4.
