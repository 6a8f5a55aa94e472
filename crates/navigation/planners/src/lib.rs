//! Global path planners and path smoothers with the behaviour of Nav2.
