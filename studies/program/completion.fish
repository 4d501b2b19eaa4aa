# Completion of rollres for fish, written by `rollres completion fish`.
function __rollres_complete
    set -l lines (rollres complete (commandline -opc)[2..] (commandline -ct) 2>/dev/null)
    set -l option (string match -r -- '^--[^=]*=' (commandline -ct))
    set -l rest (string replace -r -- '^--[^=]*=' '' (commandline -ct))
    switch $lines[1]
        case files
            printf "$option%s\n" (__fish_complete_path $rest)
        case folders
            printf "$option%s\n" (__fish_complete_directories $rest)
        case '*'
            printf '%s\n' $lines[2..]
    end
end
complete -c rollres -f -a '(__rollres_complete)'
