"""Tables as files: columns, CSV and Parquet in, all formats out."""
