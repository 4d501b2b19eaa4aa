#!/bin/sh
{{options}}

# Brings the shards together. Merging again changes nothing.

{{variables}}
"$rollres" merge "$folder"/shards/*.db --db "$database"
merged=$?
"$rollres" status "$folder/study.json" --db "$database" --shards "$tasks" || [ $merged -ne 0 ] || merged=1
exit $merged
