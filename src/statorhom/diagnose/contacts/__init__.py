"""Parts that meet over a contact of finite stiffness, whole around or lost over an arc."""
