//! PELEA: High Level Executive, Monitoring and Decision Support.
