//! LowToHigh: from binary tokens and metric attributes to n-ary predicates.
