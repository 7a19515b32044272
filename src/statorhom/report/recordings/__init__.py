"""What `statorhom modes` leaves behind: table, shapes and plots of a test's recordings."""
