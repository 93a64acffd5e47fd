"""What files hold, format by format: SVG, GeoJSON, tables, JSON, NumPy arrays and films, from bytes and to bytes."""
