"""Tables as files: the meaning of their columns, reading and writing CSV and Parquet."""
