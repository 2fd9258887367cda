//! Mission folders, contents and scenarios as typed models, checked as a whole.
